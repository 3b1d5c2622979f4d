--- Whether the spec does what the ladder does, found out while the spec is edited: the finding,
--- the actions on it, and the trace of a difference.
local t = require('harness')

local here = vim.fs.dirname(debug.getinfo(1, 'S').source:sub(2))

--- The tank with the sequence drawn by hand beside it, which is in front.
---@param name string
---@return gradus.Copy
local function tank_with_sequence(name)
  local tank = t.tank(name, function(copy)
    t.write(copy.spec, t.read(vim.fs.joinpath(here, '../../..', t.cases.neutralization.sequence)))
  end)
  vim.cmd.edit(vim.fn.fnameescape(tank.spec))
  t.wait('the verdict', function()
    return require('gradus.status').line():find('equivalent', 1, true)
  end)
  return tank
end

--- The finding of a code in the spec, once there is one.
---@param spec string
---@param code string
---@return vim.Diagnostic
local function finding(spec, code)
  return t.wait('the finding ' .. code, function()
    return vim.iter(t.findings(spec)):find(function(each)
      return each.code == code
    end)
  end)
end

--- Puts the cursor on a finding.
---@param found vim.Diagnostic
local function go_to(found)
  vim.api.nvim_win_set_cursor(0, { found.lnum + 1, found.col })
end

t.test('a difference is found while the spec is edited, and a rule about the plant excludes it', function()
  local tank = tank_with_sequence('excluded')
  vim.cmd('silent g/^e1:/d')
  local found = finding(tank.spec, 'G3201')
  t.holds(found.message, 'after 2 scans, in the last with s and ls2 on, the ladder has')
  t.wait('the verdict', function()
    return require('gradus.status').line():find('different', 1, true)
  end)
  go_to(found)
  t.act('ls1 is on whenever ls2 is')
  t.wait('no difference', function()
    return require('gradus.status').line():find('equivalent', 1, true)
  end)
  t.save_all()
  t.holds(t.read(tank.spec), 'e1: ls2 |- ls1  // ls1 is on whenever ls2 is')
  t.holds(t.gradus('verify', tank.ladder, tank.spec), 'equivalent: 8 outputs equal')
end)

t.test('the trace of a difference becomes a scenario that shows it', function()
  local tank = tank_with_sequence('traced')
  vim.cmd([[silent %s/^t1: X0\*s\*\/ls2/t1: X0*s*\/ls1/]])
  go_to(finding(tank.spec, 'G3201'))
  t.act('^Add this trace as a scenario$')
  local scenario = vim.fs.joinpath(t.scratch, 'traced-trace.scenario')
  t.is_changed(scenario)
  t.save_all()
  -- On the ladder alone it passes: what it expects is what the ladder does.
  t.holds(t.gradus('simulate', tank.ladder, scenario), 'scan')
  t.holds(t.read(scenario), 'for traced.ladder, traced.grafcet')
end)

t.test(':Gradus verify shows the verdict as the command line does', function()
  local tank = tank_with_sequence('verified')
  vim.cmd.Gradus('verify')
  t.wait('the verdict', function()
    local text = table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), '\n')
    return vim.bo.buftype == 'nofile' and text:find(vim.trim(t.gradus('verify', tank.ladder, tank.spec)), 1, true)
  end)
end)
