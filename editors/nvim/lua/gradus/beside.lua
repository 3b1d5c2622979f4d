--- Shows texts beside the window that asked for them, so that ladder and spec are seen
--- together. The cursor stays unless the server asks for it.
local M = {}

--- The window of this tab page that shows a buffer, else a new one at the side.
---@param buffer integer
---@return integer
local function window_for(buffer)
  for _, window in ipairs(vim.api.nvim_tabpage_list_wins(0)) do
    if vim.api.nvim_win_get_buf(window) == buffer then
      return window
    end
  end
  return vim.api.nvim_open_win(buffer, false, { split = 'right', win = 0 })
end

---@param buffer integer
---@param focus boolean whether the cursor goes there
---@return integer window
function M.show(buffer, focus)
  local window = window_for(buffer)
  vim.bo[buffer].buflisted = true
  if focus then
    vim.api.nvim_set_current_win(window)
  end
  return window
end

---@param uri string
---@param focus boolean
---@return integer window
function M.show_uri(uri, focus)
  local buffer = vim.uri_to_bufnr(uri)
  vim.fn.bufload(buffer)
  return M.show(buffer, focus)
end

--- Answers `window/showDocument`.
---@param params lsp.ShowDocumentParams
---@param context lsp.HandlerContext
---@return lsp.ShowDocumentResult
function M.show_document(params, context)
  if params.external then
    return { success = vim.ui.open(params.uri) ~= nil }
  end
  local window = M.show_uri(params.uri, params.takeFocus == true)
  if params.selection then
    local encoding = assert(vim.lsp.get_client_by_id(context.client_id)).offset_encoding
    local buffer = vim.api.nvim_win_get_buf(window)
    local start = params.selection.start
    local line = vim.api.nvim_buf_get_lines(buffer, start.line, start.line + 1, false)[1] or ''
    local column = vim.str_byteindex(line, encoding, start.character, false)
    vim.api.nvim_win_set_cursor(window, { math.min(start.line + 1, vim.api.nvim_buf_line_count(buffer)), column })
  end
  return { success = true }
end

--- Shows a text of the server's own in a scratch buffer, one for each title.
---@param text { title: string, language: string, text: string }
function M.show_text(text)
  local name = 'gradus://' .. text.title
  local buffer = vim.fn.bufadd(name)
  vim.fn.bufload(buffer)
  vim.bo[buffer].buftype = 'nofile'
  vim.bo[buffer].bufhidden = 'wipe'
  vim.bo[buffer].swapfile = false
  vim.bo[buffer].modifiable = true
  vim.api.nvim_buf_set_lines(buffer, 0, -1, false, vim.split(text.text, '\r?\n'))
  vim.bo[buffer].modifiable = false
  vim.bo[buffer].filetype = text.language == 'plaintext' and 'text' or text.language
  M.show(buffer, true)
end

return M
