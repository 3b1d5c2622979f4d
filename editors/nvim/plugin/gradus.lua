-- What exists before any ladder is opened: the command, the mappings' names, and the client's
-- readiness. Nothing is loaded until one of them is used.
if vim.g.loaded_gradus then
  return
end
vim.g.loaded_gradus = true

vim.api.nvim_create_user_command('Gradus', function(call)
  require('gradus.command').run(call.fargs)
end, {
  nargs = '*',
  desc = 'What Gradus can do with the ladder in this buffer',
  complete = function(begun, line)
    return require('gradus.command').complete(begun, line)
  end,
})

for name, call in pairs({
  convert = 'convert',
  handovers = 'accept',
  spec = 'spec',
  ladder = 'ladder',
  conditions = 'conditions',
  search = 'search',
  verify = 'verify',
  simulate = 'simulate',
  scan = 'scan',
  ['scan-off'] = 'scan off',
  explain = 'explain',
}) do
  vim.keymap.set('n', '<Plug>(gradus-' .. name .. ')', '<Cmd>Gradus ' .. call .. '<CR>')
end
vim.keymap.set({ 'n', 'x' }, '<Plug>(gradus-decide)', function()
  vim.lsp.buf.code_action({ context = { only = { 'refactor.gradus' }, diagnostics = {} } })
end)

local group = vim.api.nvim_create_augroup('gradus', {})
vim.api.nvim_create_autocmd('BufNewFile', {
  group = group,
  pattern = '*.grafcet',
  callback = function(event)
    require('gradus.new_spec').watch(event.buf)
  end,
})
vim.api.nvim_create_autocmd('LspNotify', {
  group = group,
  callback = function(event)
    if event.data.method == 'textDocument/didChange' or event.data.method == 'textDocument/didOpen' then
      require('gradus.findings').ask_for_others(event.buf, event.data.client_id)
    end
  end,
})

vim.lsp.enable('gradus')
