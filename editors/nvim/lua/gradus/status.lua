--- What the last analysis says of a ladder and of its spec: `b:gradus_status` of both
--- buffers, for statuslines, and the event `User GradusStatus` when it changes.
local M = {}

---@class gradus.Status
---@field uri string the ladder
---@field states integer
---@field accepted integer states that the spec has steps for
---@field open integer successions neither accepted nor rejected
---@field rules integer
---@field stale integer rules that the ladder no longer supports
---@field verdict 'no-sequence'|'no-spec'|'in-step'|'behind'
---@field message string
---@field proof? { verdict: string, message: string } whether the spec does what the ladder does

local words = {
  ['no-sequence'] = 'no sequence',
  ['no-spec'] = 'no spec',
  ['in-step'] = 'in step',
  behind = 'behind',
}

--- What is worth a word of what is known of the proof.
local proofs = {
  equivalent = 'equivalent',
  different = 'different',
  unknown = 'not known',
  refused = 'not known',
  proving = 'proving',
}

--- A ladder and the spec beside it share their path but for the ending.
---@param path string
---@return string
local function stem(path)
  return vim.fn.fnamemodify(path, ':r')
end

---@param status gradus.Status
function M.take(status)
  local ladder = vim.uri_to_fname(status.uri)
  local spec = stem(ladder) .. '.grafcet'
  for _, buffer in ipairs(vim.api.nvim_list_bufs()) do
    local name = vim.api.nvim_buf_get_name(buffer)
    if name == ladder or name == spec then
      vim.b[buffer].gradus_status = status
    end
  end
  vim.api.nvim_exec_autocmds('User', { pattern = 'GradusStatus', data = status, modeline = false })
end

--- A few words for a statusline, empty where there is nothing to say.
---@param buffer? integer
---@return string
function M.line(buffer)
  local status = vim.b[buffer or 0].gradus_status --[[@as gradus.Status?]]
  if not status then
    return ''
  end
  local open = status.open > 0 and (', %d open'):format(status.open) or ''
  local proof = status.proof and proofs[status.proof.verdict]
  return (words[status.verdict] or status.verdict) .. open .. (proof and ', ' .. proof or '')
end

return M
