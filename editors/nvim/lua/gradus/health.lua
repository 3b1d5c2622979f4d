--- `:checkhealth gradus`
local M = {}

---@param command string[]
---@return string? version, or nothing if it cannot be run
local function version_of(command)
  local ran, result = pcall(function()
    return vim.system({ command[1], '--version' }, { text = true, timeout = 5000 }):wait()
  end)
  return ran and result.code == 0 and vim.trim(result.stdout) or nil
end

function M.check()
  local health = vim.health
  health.start('gradus: editor')
  if vim.fn.has('nvim-0.11') == 1 then
    health.ok('Neovim ' .. tostring(vim.version()))
  else
    health.error('Neovim ' .. tostring(vim.version()) .. ' is too old', 'Use Neovim 0.11 or newer.')
    return
  end

  health.start('gradus: language server')
  local command = vim.lsp.config.gradus and vim.lsp.config.gradus.cmd
  if type(command) == 'function' then
    health.info('It is started by a function of yours.')
  elseif type(command) ~= 'table' then
    health.error('No command is configured.', "Set cmd in vim.lsp.config('gradus', { ... }).")
  elseif vim.fn.executable(command[1]) == 0 then
    health.error(command[1] .. ' cannot be run.', {
      'Install gradus so that it is in PATH, or name it:',
      "vim.lsp.config('gradus', { cmd = { '/path/to/gradus', 'lsp' } })",
    })
  else
    local version = version_of(command)
    if version then
      health.ok(('%s, %s'):format(version, vim.fn.exepath(command[1])))
    else
      health.error(vim.fn.exepath(command[1]) .. ' does not tell its version.', 'Is it another program of that name?')
    end
  end
  if vim.lsp.is_enabled and not vim.lsp.is_enabled('gradus') then
    health.warn('The client is disabled.', "vim.lsp.enable('gradus')")
  end

  health.start('gradus: buffers')
  local clients = vim.lsp.get_clients({ name = 'gradus' })
  for _, client in ipairs(clients) do
    for buffer in pairs(client.attached_buffers) do
      local status = require('gradus.status').line(buffer)
      local name = vim.fn.fnamemodify(vim.api.nvim_buf_get_name(buffer), ':~:.')
      health.ok(name .. (status ~= '' and (': ' .. status) or ''))
    end
  end
  if #clients == 0 then
    health.info('No buffer is served. Open a .ladder, .L5X, .L5K, .grafcet or PLCopen file.')
  end
end

return M
