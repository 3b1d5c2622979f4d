--- A spec that the server makes arrives as one edit of an empty buffer. Neovim counts the
--- line of an empty buffer as text, so the file would end in a blank line that nobody wrote;
--- this takes it away.
local M = {}

--- Watches a buffer of a file that does not exist yet, up to its first change.
---@param buffer integer
function M.watch(buffer)
  vim.api.nvim_buf_attach(buffer, false, {
    on_lines = function(_, _, _, first, _, last)
      -- Nobody types two lines at once.
      if first == 0 and last > 2 then
        vim.schedule(function()
          M.drop_blank_end(buffer)
        end)
      end
      return true
    end,
  })
end

---@param buffer integer
function M.drop_blank_end(buffer)
  if not vim.api.nvim_buf_is_loaded(buffer) then
    return
  end
  local count = vim.api.nvim_buf_line_count(buffer)
  if count > 1 and vim.api.nvim_buf_get_lines(buffer, count - 1, count, false)[1] == '' then
    vim.api.nvim_buf_call(buffer, function()
      -- One change with the edit, as far as undo is concerned.
      pcall(vim.cmd.undojoin)
      vim.api.nvim_buf_set_lines(buffer, count - 1, count, false, {})
    end)
  end
end

return M
