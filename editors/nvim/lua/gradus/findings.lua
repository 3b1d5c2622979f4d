--- What is found in a spec depends on the ladder beside it, and what a scenario expects on
--- both, whatever their names. A Neovim that asks the server for
--- findings asks for those of the buffer that changed alone; here the others are asked for.
local M = {}

local method = 'textDocument/diagnostic'

--- Asks for the findings of the other buffers that share a name but for its ending, and of all
--- scenarios.
---@param changed integer
---@param client_id integer
function M.ask_for_others(changed, client_id)
  local client = vim.lsp.get_client_by_id(client_id)
  if not client or client.name ~= 'gradus' or not client:supports_method(method, changed) then
    return
  end
  local stem = function(buffer)
    return vim.fn.fnamemodify(vim.api.nvim_buf_get_name(buffer), ':r')
  end
  local provider = client.server_capabilities.diagnosticProvider
  for other in pairs(client.attached_buffers) do
    local depends = stem(other) == stem(changed) or vim.bo[other].filetype == 'gradus-scenario'
    if other ~= changed and depends then
      client:request(method, {
        identifier = provider and provider.identifier,
        textDocument = vim.lsp.util.make_text_document_params(other),
      }, nil, other)
    end
  end
end

return M
