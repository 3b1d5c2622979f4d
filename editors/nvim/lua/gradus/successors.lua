--- The lens above a rung: what may follow it, as a list of places.
local M = {}

---@param arguments [lsp.DocumentUri, lsp.Position, lsp.Location[]]
---@param client_id integer
function M.list(arguments, client_id)
  local client = assert(vim.lsp.get_client_by_id(client_id))
  local items = vim.lsp.util.locations_to_items(arguments[3], client.offset_encoding)
  vim.fn.setloclist(0, {}, ' ', { title = 'What may follow', items = items })
  vim.cmd.lopen()
end

return M
