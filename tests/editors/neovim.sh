#!/bin/sh
# Neovim without a screen, with glint lsp started as docs/editors.md says: diagnostics, definition, fix, completion,
# formatting. The one that is installed; with a last word `fetched`, that of tools/editors.sh.
. "$(dirname -- "$0")/lib.sh"
editor nvim "${5:-}"
nvim --headless -u NONE -c 'lua if not vim.lsp then vim.cmd("cquit") end' -c 'quit' 2>/dev/null ||
    skip "this nvim has no language client"
printf 'glint: 1\nmaterials:\n  glass: {refractive_index: 1.5}\n' >materials.yaml
cat >scene.glint.yaml <<'S'
glint: 1
include: [materials.yaml]
spheres:
  - {centre: [0, 0, 0], radius: 1, material: glass}
S
cat >drive.lua <<'L'
local function fail(text) io.stderr:write(text .. "\n"); vim.cmd("cquit 1") end
local function wait(what, test) if not vim.wait(20000, test, 20) then fail("no " .. what) end end
vim.cmd("luafile recipe")
vim.cmd("edit scene.glint.yaml")
wait("diagnostics", function() return #vim.diagnostic.get(0, { severity = vim.diagnostic.severity.ERROR }) > 0 end)
local function errors() return vim.diagnostic.get(0, { severity = vim.diagnostic.severity.ERROR }) end
local found = errors()[1]
if found.code ~= "E202" or found.lnum ~= 3 or found.col ~= 5 then fail("diagnostic: " .. vim.inspect(found)) end
local client = (vim.lsp.get_clients or vim.lsp.get_active_clients)()[1]
if client.name ~= "glint" then fail("client: " .. client.name) end
-- The fix.
local params = { textDocument = { uri = vim.uri_from_bufnr(0) }, context = { diagnostics = {} },
  range = { start = { line = 3, character = 6 }, ["end"] = { line = 3, character = 6 } } }
local answer = client.request_sync("textDocument/codeAction", params, 20000, vim.api.nvim_get_current_buf())
vim.lsp.util.apply_workspace_edit(answer.result[1].edit, client.offset_encoding)
wait("fixed text", function() return vim.fn.getline(4):find("center") ~= nil end)
wait("silence", function() return #errors() == 0 end)
-- The definition, in another file.
answer = client.request_sync("textDocument/definition", { textDocument = { uri = vim.uri_from_bufnr(0) },
  position = { line = 3, character = 46 } }, 20000, vim.api.nvim_get_current_buf())
if not answer.result or not answer.result.uri:find("materials.yaml") then fail("definition: " .. vim.inspect(answer)) end
-- Completion of an attribute.
vim.fn.setline(4, "  - {center: [0, 0, 0], ra")
answer = client.request_sync("textDocument/completion", { textDocument = { uri = vim.uri_from_bufnr(0) },
  position = { line = 3, character = 26 } }, 20000, vim.api.nvim_get_current_buf())
local offered = false
for _, item in ipairs(answer.result.items) do offered = offered or item.label == "radius" end
if not offered then fail("completion: " .. vim.inspect(answer)) end
-- Formatting.
vim.fn.setline(4, "  -    {center: [0,0,0],   radius: 1, material: glass}")
vim.wait(500)
answer = client.request_sync("textDocument/formatting", { textDocument = { uri = vim.uri_from_bufnr(0) },
  options = { tabSize = 2, insertSpaces = true } }, 20000, vim.api.nvim_get_current_buf())
if not answer.result or #answer.result == 0 then fail("format: " .. vim.inspect(answer)) end
vim.lsp.util.apply_text_edits(answer.result, vim.api.nvim_get_current_buf(), client.offset_encoding)
if vim.fn.getline(4) ~= "  - {center: [0, 0, 0], radius: 1, material: glass}" then fail("formatted: " .. vim.fn.getline(4)) end
vim.cmd("qall!")
L
recipe Neovim
nvim --headless -u NONE -i NONE -n -c 'luafile drive.lua' 2>log || {
    cat log
    fail "neovim"
}
echo ok
