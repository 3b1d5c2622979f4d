//! Clients that break the protocol, in every way that one has been seen to or
//! could: the server answers as the protocol says, goes on, or ends with the
//! right status.

mod cancelling;
mod frames;
mod messages;
// Faults can be asked for in such builds only.
#[cfg(debug_assertions)]
mod panics;
mod silent;

/// Numbers of errors (LSP, `ErrorCodes`).
mod code {
    pub const PARSE_ERROR: i64 = -32700;
    pub const INVALID_REQUEST: i64 = -32600;
    pub const METHOD_NOT_FOUND: i64 = -32601;
    pub const INVALID_PARAMS: i64 = -32602;
    #[cfg(debug_assertions)]
    pub const INTERNAL_ERROR: i64 = -32603;
    pub const SERVER_NOT_INITIALIZED: i64 = -32002;
    pub const REQUEST_CANCELLED: i64 = -32800;
}
