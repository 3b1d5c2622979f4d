--- What the buffers of the project's own texts have in common.
local M = {}

--- Folds come from the server; they begin open. `vim.g.gradus_folding = false` leaves the
--- window's own way of folding alone.
---@param undo string what takes back the buffer's own options
function M.prepare(undo)
  if vim.g.gradus_folding ~= false then
    vim.wo[0][0].foldmethod = 'expr'
    vim.wo[0][0].foldexpr = 'v:lua.vim.lsp.foldexpr()'
    vim.wo[0][0].foldlevel = 99
    undo = undo .. ' | setlocal foldmethod< foldexpr< foldlevel<'
  end
  vim.b.undo_ftplugin = undo
end

return M
