--- A scenario beside its ladder: findings while the ladder is changed, the action that mends
--- them, the table of scans, and a scan shown in the ladder.
local t = require('harness')

--- The tank with a scenario of its name beside it, which is in front.
---@param name string
---@return gradus.Copy tank, string scenario
local function tank_with_scenario(name)
  local tank = t.tank(name)
  local scenario = vim.fs.joinpath(t.scratch, name .. '.scenario')
  t.write(scenario, 'on s => only on v1\noff s => only\n')
  vim.cmd.edit(vim.fn.fnameescape(scenario))
  t.wait('a client', function()
    return require('gradus.client').of(0)
  end)
  return tank, scenario
end

---@return string
local function text()
  return table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), '\n')
end

--- The text of all inlay hints of a buffer.
---@param buffer integer
---@return string
local function hints(buffer)
  local labels = vim.tbl_map(function(each)
    return each.inlay_hint.label
  end, vim.lsp.inlay_hint.get({ bufnr = buffer }))
  return table.concat(labels, ' ')
end

t.test('an expectation fails when the ladder is changed, and an action takes over what it does', function()
  local tank, scenario = tank_with_scenario('expected')
  t.equal(#t.findings(scenario), 0)
  vim.api.nvim_buf_call(tank.buffer, function()
    vim.cmd('silent %s/(s + v1)/s/')
  end)
  local found = t.wait('a finding', function()
    return t.findings(scenario)[1]
  end)
  t.equal(found.code, 'G5003')
  t.holds(found.message, 'v1 should stay on after scan 2, but the ladder has it off')
  t.go_to('off s')
  t.act('^Expect what the ladder does$')
  t.wait('the new expectation', function()
    return text() == 'on s => only on v1\noff s => only off v1'
  end)
  t.wait('no finding', function()
    return #t.findings(scenario) == 0
  end)
  t.save_all()
  t.holds(t.gradus('check', '--json', scenario), '"diagnostics": []')
end)

t.test(':Gradus simulate shows the scans as the command line does', function()
  local _, scenario = tank_with_scenario('table')
  vim.cmd.Gradus('simulate')
  t.wait('the table', function()
    return vim.bo.buftype == 'nofile' and text():find('all is as expected', 1, true)
  end)
  t.holds(text(), vim.trim(t.gradus('simulate', scenario)))
end)

t.test(':Gradus scan shows a scan in the ladder, and takes it back', function()
  local tank, scenario = tank_with_scenario('scan')
  vim.cmd.split()
  vim.cmd.buffer(tank.buffer)
  vim.lsp.inlay_hint.enable(true, { bufnr = tank.buffer })
  t.wait('the usual hints', function()
    return hints(tank.buffer):find('holds while', 1, true)
  end)
  vim.cmd.wincmd('p')
  t.equal(vim.api.nvim_get_current_buf(), vim.fn.bufnr(scenario))
  t.go_to('on s')
  vim.cmd.Gradus('scan')
  t.wait('power in the ladder', function()
    return hints(tank.buffer):find('●', 1, true)
  end)
  -- In the second scan the valve holds itself: power comes through its own contact.
  local rung = vim.api.nvim_buf_get_lines(tank.buffer, 20, 21, false)[1]
  local _, contact = rung:find('+ v1', 1, true)
  vim.cmd('Gradus scan 2')
  t.wait('power through the contact', function()
    return vim.iter(vim.lsp.inlay_hint.get({ bufnr = tank.buffer })):any(function(each)
      local at = each.inlay_hint.position
      return at.line == 20 and at.character == contact and each.inlay_hint.label == '●'
    end)
  end)
  vim.cmd('Gradus scan off')
  t.wait('the usual hints again', function()
    local all = hints(tank.buffer)
    return all:find('holds while', 1, true) and not all:find('●', 1, true)
  end)
end)

t.test('a rename in the scenario changes the ladder too, and what is saved still holds', function()
  local tank, scenario = tank_with_scenario('renamed')
  t.go_to('on v1', 3)
  vim.lsp.buf.rename('fill')
  t.is_changed(tank.ladder)
  t.save_all()
  t.equal(t.read(scenario), 'on s => only on fill\noff s => only\n')
  t.holds(t.read(tank.ladder), '(s + fill) * /ls2')
  t.holds(t.gradus('check', '--json', scenario), '"diagnostics": []')
end)

t.test(':Gradus simulate says where there is no scenario', function()
  t.tank('no-scenario')
  local said
  local notify = vim.notify
  ---@diagnostic disable-next-line: duplicate-set-field
  vim.notify = function(message)
    said = message
  end
  vim.cmd.Gradus('simulate')
  vim.notify = notify
  t.holds(said, 'no scenario')
end)
