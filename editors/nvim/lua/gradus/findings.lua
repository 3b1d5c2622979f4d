--- What is found in a spec depends on the ladder beside it, and what a scenario expects on
--- both, whatever their names. A Neovim that asks the server for
--- findings asks for those of the buffer that changed alone; here the others are asked for.
local M = {}

local method = 'textDocument/diagnostic'

--- Asks for the findings of a buffer.
---@param client vim.lsp.Client
---@param buffer integer
local function ask(client, buffer)
  local provider = client.server_capabilities.diagnosticProvider
  client:request(method, {
    identifier = provider and provider.identifier,
    textDocument = vim.lsp.util.make_text_document_params(buffer),
  }, nil, buffer)
end

--- Answers `workspace/diagnostic/refresh`. Neovim 0.12 asks for findings in files that are in no
--- buffer then, and fails once a buffer was wiped out; here the buffers are asked for.
---@param failure? lsp.ResponseError
---@param params any
---@param context lsp.HandlerContext
---@return any
function M.refresh(failure, params, context)
  local usual = vim.lsp.handlers['workspace/diagnostic/refresh']
  if usual then
    pcall(usual, failure, params, context)
  end
  local client = vim.lsp.get_client_by_id(context.client_id)
  for buffer in pairs(client and client.attached_buffers or {}) do
    if client and vim.api.nvim_buf_is_valid(buffer) and client:supports_method(method, buffer) then
      ask(client, buffer)
    end
  end
  return vim.NIL
end

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
  for other in pairs(client.attached_buffers) do
    local depends = stem(other) == stem(changed) or vim.bo[other].filetype == 'gradus-scenario'
    if other ~= changed and depends then
      ask(client, other)
    end
  end
end

return M
