--- What needs no server: filetypes, colours, help, health, completion of the command.
local t = require('harness')

local root = vim.fs.normalize(vim.fs.joinpath(vim.fs.dirname(debug.getinfo(1, 'S').source:sub(2)), '../../..'))

t.test('filetypes are found by their endings, and XML stays XML', function()
  for name, filetype in pairs({
    ['a.ladder'] = 'gradus-ladder',
    ['a.grafcet'] = 'grafcet',
    ['a.scenario'] = 'gradus-scenario',
    ['a.L5K'] = 'neutral-text',
    ['a.L5X'] = 'xml',
  }) do
    t.equal(vim.filetype.match({ filename = name }), filetype, name)
  end
end)

t.test('comments are made and folds are open', function()
  vim.cmd.edit(t.scratch .. '/new.grafcet')
  t.equal(vim.bo.commentstring, '// %s')
  t.equal(vim.wo.foldexpr, 'v:lua.vim.lsp.foldexpr()')
  t.equal(vim.wo.foldlevel, 99)
  vim.cmd.setfiletype('gradus-ladder')
end)

--- The highlight group of the first place that holds a text.
local function colour(file, filetype, text, into)
  vim.cmd.edit(root .. '/fixtures/' .. file)
  vim.bo.filetype = filetype
  t.go_to(text, into)
  local line, column = unpack(vim.api.nvim_win_get_cursor(0))
  local id
  -- Without a screen a line's colours are worked out only as far as asked, from its beginning.
  for each = 1, column + 1 do
    id = vim.fn.synID(line, each, 1)
  end
  return vim.fn.synIDattr(id, 'name')
end

t.test('texts are coloured', function()
  for _, case in ipairs({
    { 'ladder/everything.ladder', 'gradus-ladder', 'program Everything', 0, 'gradusKeyword' },
    { 'ladder/everything.ladder', 'gradus-ladder', '// Start button', 3, 'gradusComment' },
    { 'ladder/everything.ladder', 'gradus-ladder', '"Contacts"', 2, 'gradusTitle' },
    { 'ladder/everything.ladder', 'gradus-ladder', 'set latch', 0, 'gradusWrite' },
    { 'ladder/everything.ladder', 'gradus-ladder', 'TON(t1', 0, 'gradusTimerBox' },
    { 'ladder/everything.ladder', 'gradus-ladder', '1m30s', 0, 'gradusTime' },
    { 'ladder/everything.ladder', 'gradus-ladder', '-> run', 0, 'gradusDrives' },
    { 'grafcet/everything.grafcet', 'grafcet', 'Transitions:', 0, 'grafcetSection' },
    { 'grafcet/everything.grafcet', 'grafcet', 't1: X0', 0, 'grafcetLabel' },
    { 'grafcet/everything.grafcet', 'grafcet', '@Xv1', 0, 'grafcetNext' },
    { 'grafcet/everything.grafcet', 'grafcet', '//! accept', 5, 'grafcetDecision' },
    { 'grafcet/everything.grafcet', 'grafcet', 'after 2s', 0, 'grafcetWord' },
    { 'rockwell/conveyor.L5K', 'neutral-text', 'XIC(Start)', 0, 'neutralTextContact' },
    { 'rockwell/conveyor.L5K', 'neutral-text', 'END_DATATYPE', 1, 'neutralTextComponent' },
  }) do
    local file, filetype, text, into, group = unpack(case)
    t.equal(colour(file, filetype, text, into), group, file .. ' ' .. text)
  end
end)

t.test('the command completes its subcommands and what they take', function()
  local complete = function(line)
    return vim.fn.getcompletion(line, 'cmdline')
  end
  t.equal(complete('Gradus con'), { 'conditions', 'convert' })
  t.equal(complete('Gradus convert '), { 'none', 'handover', 'witnessed', 'all' })
  t.equal(complete('Gradus s'), { 'scan', 'search', 'simulate', 'spec' })
  t.equal(complete('Gradus scan '), { 'off' })
  t.equal(complete('Gradus spec '), {})
end)

t.test('an unknown subcommand is refused with the list', function()
  local said
  local notify = vim.notify
  ---@diagnostic disable-next-line: duplicate-set-field
  vim.notify = function(message)
    said = message
  end
  vim.cmd('Gradus nonsense')
  vim.notify = notify
  t.holds(said, 'nonsense')
  t.holds(said, 'convert')
end)

t.test('help is found for every subcommand and mapping', function()
  local text = vim.api.nvim_get_runtime_file('doc/gradus.txt', false)[1]
  vim.cmd.helptags(vim.fs.dirname(text))
  for _, subject in ipairs({ 'gradus', 'gradus-mappings', 'gradus-settings', 'b:gradus_status', ':Gradus' }) do
    vim.cmd.help(subject)
    t.equal(vim.fs.basename(vim.api.nvim_buf_get_name(0)), 'gradus.txt', subject)
  end
  local help = t.read(text)
  for _, name in ipairs(vim.fn.getcompletion('Gradus ', 'cmdline')) do
    t.holds(help, '*:Gradus-' .. name .. '*')
  end
  for _, mapping in ipairs(vim.api.nvim_get_keymap('n')) do
    if mapping.lhs:find('^<Plug>%(gradus%-') then
      t.holds(help, mapping.lhs)
    end
  end
end)

t.test('health tells about editor and executable', function()
  vim.cmd.checkhealth('gradus')
  local said = t.wait('the health report', function()
    local text = table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), '\n')
    return text:find('buffers') and text
  end)
  t.holds(said, 'Neovim ' .. tostring(vim.version()))
  t.holds(said, 'gradus ' .. vim.trim(t.gradus('--version')):match('%S+$'))
  assert(not said:find('ERROR'), said)
end)

t.test('XML that holds no ladder gets no client', function()
  local path = t.scratch .. '/settings.xml'
  t.write(path, '<?xml version="1.0"?>\n<settings><pump start="1">XIC(a)OTE(b);</pump></settings>\n')
  vim.cmd.edit(path)
  t.equal(vim.bo.filetype, 'xml')
  vim.wait(300)
  t.equal(#vim.lsp.get_clients({ bufnr = 0 }), 0)
end)
