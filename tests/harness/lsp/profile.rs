use serde_json::{Value, json};

/// What kind of client the server talks to: each says other things about
/// itself, and the server answers each as it can understand it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profile {
    /// Visual Studio Code: UTF-16, asks for findings, can do nearly everything.
    VsCode,
    /// Neovim 0.11: bytes, versioned edits, no watched files.
    Neovim,
    /// Helix 25: bytes, asks for findings, no semantic tokens.
    Helix,
    /// Emacs with eglot 1.9: UTF-16 without a word, findings are pushed.
    Eglot,
    /// A client that says nothing about itself.
    Plain,
}

impl Profile {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::VsCode,
        Self::Neovim,
        Self::Helix,
        Self::Eglot,
        Self::Plain,
    ];

    /// What the client says that it can do, as far as a server may care.
    pub fn capabilities(self) -> Value {
        match self {
            Self::VsCode => json!({
                "general": { "positionEncodings": ["utf-16"] },
                "window": {
                    "workDoneProgress": true,
                    "showDocument": { "support": true },
                    "showMessage": { "messageActionItem": { "additionalPropertiesSupport": true } }
                },
                "workspace": {
                    "applyEdit": true,
                    "configuration": true,
                    "workspaceFolders": true,
                    "didChangeConfiguration": { "dynamicRegistration": true },
                    "didChangeWatchedFiles": { "dynamicRegistration": true },
                    "codeLens": { "refreshSupport": true },
                    "inlayHint": { "refreshSupport": true },
                    "semanticTokens": { "refreshSupport": true },
                    "diagnostics": { "refreshSupport": true },
                    "workspaceEdit": {
                        "documentChanges": true,
                        "resourceOperations": ["create", "rename", "delete"],
                        "failureHandling": "textOnlyTransactional",
                        "changeAnnotationSupport": { "groupsOnLabel": true }
                    }
                },
                "textDocument": {
                    "hover": { "contentFormat": ["markdown", "plaintext"] },
                    "completion": {
                        "completionItem": { "snippetSupport": true, "labelDetailsSupport": true }
                    },
                    "inlineCompletion": { "dynamicRegistration": true },
                    "definition": { "linkSupport": true },
                    "documentSymbol": { "hierarchicalDocumentSymbolSupport": true },
                    "codeAction": {
                        "dataSupport": true,
                        "disabledSupport": true,
                        "isPreferredSupport": true,
                        "honorsChangeAnnotations": true,
                        "resolveSupport": { "properties": ["edit"] },
                        "codeActionLiteralSupport": { "codeActionKind": { "valueSet": [
                            "", "quickfix", "refactor", "source"
                        ] } }
                    },
                    "rename": { "prepareSupport": true, "honorsChangeAnnotations": true },
                    "publishDiagnostics": {
                        "relatedInformation": true,
                        "versionSupport": false,
                        "codeDescriptionSupport": true,
                        "tagSupport": { "valueSet": [1, 2] }
                    },
                    "diagnostic": { "dynamicRegistration": true, "relatedDocumentSupport": false },
                    "semanticTokens": semantic_tokens(),
                    "callHierarchy": { "dynamicRegistration": true }
                },
                "experimental": { "gradusStatus": true, "gradusVirtualDocuments": true, "gradusPages": true }
            }),
            Self::Neovim => json!({
                "general": { "positionEncodings": ["utf-8", "utf-16", "utf-32"] },
                "window": {
                    "workDoneProgress": true,
                    "showDocument": { "support": true },
                    "showMessage": { "messageActionItem": { "additionalPropertiesSupport": true } }
                },
                "workspace": {
                    "applyEdit": true,
                    "configuration": true,
                    "workspaceFolders": true,
                    "didChangeWatchedFiles": { "dynamicRegistration": false },
                    "inlayHint": { "refreshSupport": true },
                    "semanticTokens": { "refreshSupport": true },
                    "workspaceEdit": { "resourceOperations": ["rename", "create", "delete"] }
                },
                "textDocument": {
                    "hover": { "contentFormat": ["markdown", "plaintext"] },
                    "completion": { "completionItem": { "snippetSupport": true } },
                    "definition": { "linkSupport": true },
                    "documentSymbol": { "hierarchicalDocumentSymbolSupport": true },
                    "codeAction": {
                        "dataSupport": true,
                        "isPreferredSupport": true,
                        "resolveSupport": { "properties": ["edit", "command"] },
                        "codeActionLiteralSupport": { "codeActionKind": { "valueSet": [
                            "", "quickfix", "refactor", "source"
                        ] } }
                    },
                    "rename": { "prepareSupport": true },
                    "publishDiagnostics": { "relatedInformation": true, "tagSupport": { "valueSet": [1, 2] } },
                    "diagnostic": { "dynamicRegistration": false },
                    "semanticTokens": semantic_tokens()
                }
            }),
            Self::Helix => json!({
                "general": { "positionEncodings": ["utf-8", "utf-32", "utf-16"] },
                "window": { "workDoneProgress": true, "showDocument": { "support": true } },
                "workspace": {
                    "applyEdit": true,
                    "configuration": true,
                    "workspaceFolders": true,
                    "didChangeWatchedFiles": { "dynamicRegistration": true },
                    "diagnostics": { "refreshSupport": true },
                    "workspaceEdit": {
                        "documentChanges": true,
                        "resourceOperations": ["create", "rename", "delete"],
                        "failureHandling": "abort"
                    }
                },
                "textDocument": {
                    "hover": { "contentFormat": ["markdown"] },
                    "completion": { "completionItem": { "snippetSupport": true } },
                    "codeAction": {
                        "dataSupport": true,
                        "resolveSupport": { "properties": ["edit", "command"] },
                        "codeActionLiteralSupport": { "codeActionKind": { "valueSet": [
                            "", "quickfix", "refactor", "source"
                        ] } }
                    },
                    "rename": { "prepareSupport": true },
                    "publishDiagnostics": { "versionSupport": true, "tagSupport": { "valueSet": [1, 2] } },
                    "diagnostic": { "dynamicRegistration": false }
                }
            }),
            Self::Eglot => json!({
                "window": { "workDoneProgress": true },
                "workspace": {
                    "applyEdit": true,
                    "configuration": true,
                    "workspaceFolders": true,
                    "didChangeWatchedFiles": { "dynamicRegistration": true },
                    "workspaceEdit": { "documentChanges": true }
                },
                "textDocument": {
                    "hover": { "contentFormat": ["plaintext"] },
                    "documentSymbol": { "hierarchicalDocumentSymbolSupport": true },
                    "codeAction": { "isPreferredSupport": true },
                    "publishDiagnostics": { "relatedInformation": false }
                },
                "experimental": {}
            }),
            Self::Plain => json!({}),
        }
    }

    /// Whether the client counts columns in bytes.
    pub fn counts_bytes(self) -> bool {
        matches!(self, Self::Neovim | Self::Helix)
    }
}

fn semantic_tokens() -> Value {
    json!({
        "requests": { "range": true, "full": { "delta": false } },
        "tokenTypes": ["variable", "parameter", "property", "keyword", "comment", "string",
            "number", "operator", "function", "class", "event", "enumMember", "namespace"],
        "tokenModifiers": ["declaration", "definition", "readonly", "modification"],
        "formats": ["relative"]
    })
}
