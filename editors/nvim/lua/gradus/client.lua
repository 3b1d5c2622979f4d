--- The client of the language server: what it starts, for which buffers, and what it tells
--- the server of itself.
local M = {}

--- Buffers whose text the server understands. XML belongs to everybody and is looked into.
M.filetypes = { 'gradus-ladder', 'grafcet', 'gradus-scenario', 'neutral-text', 'xml', 'l5x' }

--- Whether the beginning of a text is that of a Rockwell or PLCopen export.
---@param text string
---@return boolean
function M.begins_as_ladder_xml(text)
  return text:find('<RSLogix5000Content[%s>]') ~= nil or text:lower():find('www.plcopen.org/xml/tc6', 1, true) ~= nil
end

--- Whether a buffer is one for the server: of the project's own texts, or XML that holds ladder.
---@param buffer integer
---@return boolean
function M.concerns(buffer)
  local filetype = vim.bo[buffer].filetype
  if filetype ~= 'xml' and filetype ~= 'l5x' then
    return vim.list_contains(M.filetypes, filetype)
  end
  local lines = vim.api.nvim_buf_get_lines(buffer, 0, 100, false)
  return M.begins_as_ladder_xml(table.concat(lines, '\n'):sub(1, 4096))
end

--- The client of a buffer, if it is attached.
---@param buffer? integer 0 or nil for the current one
---@return vim.lsp.Client?
function M.of(buffer)
  return vim.lsp.get_clients({ bufnr = buffer or 0, name = 'gradus' })[1]
end

---@return vim.lsp.ClientCapabilities
local function capabilities()
  local all = vim.lsp.protocol.make_client_capabilities()
  all.experimental = { gradusStatus = true, gradusPages = true }
  return all
end

---@return vim.lsp.Config
function M.config()
  return {
    cmd = { 'gradus', 'lsp' },
    filetypes = M.filetypes,
    -- Without a call of `attach` no client is started for the buffer.
    root_dir = function(buffer, attach)
      if M.concerns(buffer) then
        local path = vim.api.nvim_buf_get_name(buffer)
        attach(vim.fs.root(buffer, '.git') or vim.fs.dirname(path))
      end
    end,
    settings = { gradus = vim.empty_dict() },
    before_init = function(params, config)
      params.initializationOptions = config.settings and config.settings.gradus or nil
    end,
    capabilities = capabilities(),
    handlers = {
      ['gradus/status'] = function(_, status)
        require('gradus.status').take(status)
      end,
      ['workspace/diagnostic/refresh'] = function(...)
        return require('gradus.findings').refresh(...)
      end,
      ['window/showDocument'] = function(_, params, context)
        return require('gradus.beside').show_document(params, context)
      end,
    },
    commands = {
      ['gradus.simulate'] = function(command)
        require('gradus.command').simulate(command.arguments[1].uri)
      end,
      ['gradus.verify'] = function(command)
        require('gradus.command').verify(command.arguments[1].uri)
      end,
      ['gradus.explain'] = function(command)
        require('gradus.command').run({ 'explain', command.arguments[1] })
      end,
    },
  }
end

return M
