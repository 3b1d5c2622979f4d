--- What a person reads and decides, by keyboard, and the spec that comes of it. What is saved
--- is compared with what the command line writes for the same decisions.
local t = require('harness')

local case, real = t.cases.neutralization, t.cases.real
local together = 'Accept v1 %-> .*together'

t.test('K tells the conditions of a coil', function()
  t.tank('hover')
  t.go_to('-> ' .. case.hover.coil, 3)
  local said = t.float('K')
  for _, words in ipairs(case.hover.shows) do
    t.holds(said, words)
  end
end)

t.test('K tells the sequence in which a state was seen to follow, once it was searched for', function()
  t.tank('searched')
  t.go_to('-> ' .. case.hover.coil, 3)
  vim.cmd.Gradus('search')
  t.wait('what was seen', function()
    return vim.fn.execute('messages'):find('30 successions seen', 1, true)
  end)
  t.holds(t.float('K'), 'seen after: on s; on ls2')
end)

t.test('K tells the conditions of a coil inside a real L5X export', function()
  local file = vim.fs.joinpath(t.corpus, real.file)
  if not vim.uv.fs_stat(file) then
    assert(vim.env.CI ~= 'true', file .. ': no such file, and CI=true demands the corpus')
    io.stdout:write('skip no corpus\n')
    return
  end
  t.open('real', file)
  t.equal(vim.bo.filetype, 'xml')
  t.go_to(real.hover.written, #'OTE(')
  local said = t.float('K')
  for _, words in ipairs(real.hover.shows) do
    t.holds(said, words)
  end
end)

t.test('v1 -> v2, h and m are accepted together, and the spec is made', function()
  local tank = t.tank('accept')
  t.go_to('-> v1', 3)
  t.act(together)
  t.is_changed(tank.spec)
  vim.cmd.Gradus('spec')
  t.wait('the spec beside the ladder', function()
    return #vim.api.nvim_tabpage_list_wins(0) == 2
  end)
  t.save_all()
  t.equal(t.read(tank.spec), t.spec_with(tank, '--accept', case.together.pair))
  t.equal(t.read(tank.ladder), tank.original)
end)

t.test('undo takes an acceptance back', function()
  local tank = t.tank('undo', function(copy)
    t.gradus('convert', copy.ladder)
  end)
  local before = t.read(tank.spec)
  t.go_to('-> v1', 3)
  t.act(together)
  t.is_changed(tank.spec)
  t.save_all()
  t.equal(t.read(tank.spec), t.spec_updated(tank, before, '--accept', case.together.pair))
  vim.cmd.buffer(vim.fn.bufnr(tank.spec))
  t.type('u')
  t.save_all()
  t.equal(t.read(tank.spec), before)
end)

t.test('a succession is rejected, and the spec remembers it', function()
  local tank = t.tank('reject', function(copy)
    t.gradus('convert', copy.ladder)
  end)
  t.go_to('-> v1', 3)
  t.act('Reject v1 %-> v4', '<Plug>(gradus-decide)')
  t.is_changed(tank.spec)
  t.save_all()
  local spec = t.read(tank.spec)
  assert(vim.list_contains(vim.split(spec, '\n'), case.rejected.decision), spec)
  local rest = vim.tbl_filter(function(line)
    return not vim.startswith(line, '//!')
  end, vim.split(spec, '\n'))
  t.equal(vim.trim(table.concat(rest, '\n')), vim.trim(t.spec_with(tank)))
end)

t.test('a rung that is edited makes rules stale, and the fix mends them', function()
  local tank = t.tank('stale', function(copy)
    t.gradus('convert', copy.ladder, '--accept', case.together.pair)
  end)
  vim.cmd.Gradus('spec')
  t.buffer_of(tank.spec)
  -- v1 is now closed by the upper level.
  vim.api.nvim_set_current_win(vim.fn.bufwinid(tank.ladder))
  t.go_to('/ls2                       -> v1', 1)
  t.type('cels3<Esc>')
  local warning = vim.diagnostic.severity.WARN
  t.wait('stale rules', function()
    return #t.findings(tank.spec, warning) > 0
  end)
  t.equal(t.findings(tank.spec, warning)[1].code, 'G3101')
  t.wait('the verdict', function()
    return require('gradus.status').line():find('behind')
  end)
  vim.api.nvim_set_current_win(vim.fn.bufwinid(tank.spec))
  for _ = 1, 10 do
    local left = #t.findings(tank.spec, warning)
    if left == 0 then
      break
    end
    t.type('gg]d')
    t.act('Take over what the ladder gives')
    t.wait('the finding goes', function()
      return #t.findings(tank.spec, warning) < left
    end)
  end
  t.save_all()
  t.equal(t.read(tank.ladder), (tank.original:gsub('%(s %+ v1%) %* /ls2 ', '(s + v1) * /ls3 ')))
  t.equal(t.saved_findings(tank), {})
  t.equal(t.read(tank.spec), t.spec_with(tank, '--accept', case.together.pair))
end)

t.test('a rename changes ladder and spec together', function()
  local tank = t.tank('rename', function(copy)
    t.gradus('convert', copy.ladder, '--accept', case.together.pair)
  end)
  t.go_to('-> v2', 3)
  vim.lsp.buf.rename('dose')
  t.is_changed(tank.ladder)
  t.is_changed(tank.spec)
  t.save_all()
  local renamed = tank.original:gsub('output v2 ', 'output dose '):gsub('%(v2 %+ ls2', '(dose + ls2'):gsub('%-> v2', '-> dose')
  -- Columns may be laid out anew; names may not differ.
  t.equal((t.read(tank.ladder):gsub(' +', ' ')), (renamed:gsub(' +', ' ')))
  local spec = t.read(tank.spec)
  t.holds(spec, ' for dose')
  t.holds(spec, '//! accept v1 -> dose & h & m')
  t.equal(t.saved_findings(tank), {})
end)

t.test('Windows line ends stay', function()
  local tank = t.tank('crlf', function(copy)
    t.write(copy.ladder, (copy.original:gsub('\n', '\r\n')))
    t.gradus('convert', copy.ladder)
    t.write(copy.spec, (t.read(copy.spec):gsub('\r?\n', '\r\n')))
  end)
  t.go_to('-> v1', 3)
  t.act(together)
  t.is_changed(tank.spec)
  t.save_all()
  local spec = t.read(tank.spec)
  t.holds(spec, case.together.decision .. '\r\n')
  assert(not spec:find('[^\r]\n'), spec)
end)
