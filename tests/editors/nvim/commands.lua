--- The subcommands of :Gradus, the statusline, and the server's life.
local t = require('harness')

local function lines()
  return table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), '\n')
end

t.test(':Gradus convert makes the spec and shows it; the statusline follows', function()
  local tank = t.tank('convert')
  t.holds(require('gradus.status').line(), 'no spec')
  vim.cmd.Gradus('convert')
  t.wait('the spec beside the ladder', function()
    return vim.fn.bufwinid(tank.spec) > 0
  end)
  t.equal(vim.api.nvim_get_current_buf(), tank.buffer, 'the cursor stays')
  t.wait('the verdict', function()
    return require('gradus.status').line():find('in step')
  end)
  t.save_all()
  t.equal(t.read(tank.spec), t.spec_with(tank))
end)

t.test(':Gradus accept accepts all handovers', function()
  local tank = t.tank('handovers')
  vim.cmd.Gradus('accept')
  t.is_changed(tank.spec)
  t.save_all()
  t.equal(t.read(tank.spec), t.spec_with(tank, '--accept', 'handover'))
end)

t.test(':Gradus conditions shows the conditions of all coils', function()
  t.tank('conditions')
  vim.cmd.Gradus('conditions')
  t.wait('the conditions', function()
    return vim.bo.buftype == 'nofile' and lines():find('Open valve v1', 1, true)
  end)
  t.equal(vim.bo.modifiable, false)
end)

t.test(':Gradus ladder shows an XML file as rungs', function()
  local root = vim.fs.joinpath(vim.fs.dirname(debug.getinfo(1, 'S').source:sub(2)), '../../..')
  t.open('text', vim.fs.joinpath(root, 'fixtures/neutralization/neutralization.L5X'))
  vim.cmd.Gradus('ladder')
  t.wait('the rungs', function()
    return vim.bo.filetype == 'gradus-ladder' and lines():find('rung')
  end)
end)

t.test(':Gradus explain shows the page of a code', function()
  t.tank('explain')
  vim.cmd('Gradus explain G2002')
  t.wait('the page', function()
    return vim.bo.filetype == 'markdown' and lines():find('G2002', 1, true)
  end)
end)

t.test(':Gradus report names the versions', function()
  t.tank('report')
  vim.cmd.Gradus('report')
  t.wait('the report', function()
    return vim.bo.filetype == 'markdown' and lines():find('Neovim ' .. tostring(vim.version()), 1, true)
  end)
end)

t.test(':Gradus restart starts another server that knows the buffer', function()
  local tank = t.tank('restart')
  local before = require('gradus.client').of(tank.buffer).id
  vim.b[tank.buffer].gradus_status = nil
  vim.cmd.Gradus('restart')
  t.wait('another client', function()
    local client = require('gradus.client').of(tank.buffer)
    return client and client.id ~= before and client.initialized
  end)
  t.wait('an analysis', function()
    return vim.b[tank.buffer].gradus_status
  end)
end)
