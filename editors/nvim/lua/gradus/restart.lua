--- Ends the language server and starts it anew for the buffers that it served.
local M = {}

function M.restart()
  local client = require('gradus.client').of(0) or vim.lsp.get_clients({ name = 'gradus' })[1]
  if not client then
    vim.lsp.enable('gradus')
    return
  end
  client:stop()
  local timer = assert(vim.uv.new_timer())
  local waited = 0
  timer:start(50, 50, function()
    waited = waited + 50
    if not client:is_stopped() and waited < 3000 then
      return
    end
    timer:close()
    vim.schedule(function()
      if not client:is_stopped() then
        client:stop(true)
      end
      -- Attaches to every buffer that is open, as it does when Neovim starts.
      vim.lsp.enable('gradus')
    end)
  end)
end

return M
