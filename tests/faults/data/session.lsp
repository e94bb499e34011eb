{"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{"general":{"positionEncodings":["utf-8"]}}}}
{"jsonrpc":"2.0","method":"initialized","params":{}}
{"jsonrpc":"2.0","method":"textDocument/didOpen","params":{"textDocument":{"uri":"file://@/good.glint.yaml","languageId":"yaml","version":1,"text":"glint: 1\nmaterials:\n  glass: {albedo: [0, 0.5, 0.1, 0.8]}\nspheres:\n  - {center: [0, 0, 0], radius: 1, material: glas}\nmodels:\n  - {mesh: more/tent.obj, material: glass}\n"}}}
{"jsonrpc":"2.0","id":2,"method":"textDocument/codeAction","params":{"textDocument":{"uri":"file://@/good.glint.yaml"},"range":{"start":{"line":4,"character":44},"end":{"line":4,"character":46}},"context":{"diagnostics":[]}}}
{"jsonrpc":"2.0","method":"textDocument/didChange","params":{"textDocument":{"uri":"file://@/good.glint.yaml","version":2},"contentChanges":[{"range":{"start":{"line":4,"character":47},"end":{"line":4,"character":47}},"text":"s"}]}}
{"jsonrpc":"2.0","id":3,"method":"textDocument/definition","params":{"textDocument":{"uri":"file://@/good.glint.yaml"},"position":{"line":4,"character":45}}}
{"jsonrpc":"2.0","id":4,"method":"textDocument/references","params":{"textDocument":{"uri":"file://@/good.glint.yaml"},"position":{"line":2,"character":4},"context":{"includeDeclaration":true}}}
{"jsonrpc":"2.0","id":5,"method":"textDocument/rename","params":{"textDocument":{"uri":"file://@/good.glint.yaml"},"position":{"line":2,"character":4},"newName":"ice"}}
{"jsonrpc":"2.0","id":6,"method":"textDocument/hover","params":{"textDocument":{"uri":"file://@/good.glint.yaml"},"position":{"line":4,"character":25}}}
{"jsonrpc":"2.0","id":7,"method":"textDocument/documentSymbol","params":{"textDocument":{"uri":"file://@/good.glint.yaml"}}}
{"jsonrpc":"2.0","id":8,"method":"textDocument/documentLink","params":{"textDocument":{"uri":"file://@/good.glint.yaml"}}}
{"jsonrpc":"2.0","id":9,"method":"textDocument/completion","params":{"textDocument":{"uri":"file://@/good.glint.yaml"},"position":{"line":6,"character":16}}}
{"jsonrpc":"2.0","id":10,"method":"textDocument/formatting","params":{"textDocument":{"uri":"file://@/good.glint.yaml"},"options":{"tabSize":2,"insertSpaces":true}}}
{"jsonrpc":"2.0","method":"textDocument/didSave","params":{"textDocument":{"uri":"file://@/good.glint.yaml"}}}
{"jsonrpc":"2.0","method":"textDocument/didClose","params":{"textDocument":{"uri":"file://@/good.glint.yaml"}}}
{"jsonrpc":"2.0","id":11,"method":"shutdown"}
{"jsonrpc":"2.0","method":"exit"}
