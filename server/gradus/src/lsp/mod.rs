//! The language server: `gradus lsp`.
//!
//! ```text
//! stdin -> Input -> tower-lsp -> Guard -> Server -> State (documents, settings)
//!                                            |         | World, a snapshot
//!                                            v         v
//! stdout <- Output <- tower-lsp <------- requests/* on threads of their own
//! ```
//!
//! The protocol library reads messages and calls handlers, all on one task. A
//! handler does two things there: it changes the [`State`](world::State) or
//! takes a snapshot of it, and hands the work to another thread, with a flag
//! that says when nobody wants the answer any more. So nothing that a file
//! holds can keep the server from answering.
//!
//! `requests/` has one file for each request of the protocol. Each asks the
//! `ide` crate, which knows bytes and names, and says the answer in the
//! protocol's types; only [`position`] turns bytes into lines and columns.

mod abilities;
mod capabilities;
mod checked;
mod disk;
mod document;
mod edit;
mod fault;
mod files;
mod folders;
mod guard;
mod in_force;
mod index;
mod key;
mod log;
mod parent;
mod plant;
mod position;
mod progress;
mod proving;
mod publish;
mod query;
mod requests;
mod runs;
mod searching;
mod server;
mod settings;
mod shown;
mod simulation;
mod status;
mod teller;
mod telling;
mod transport;
mod verdicts;
mod virtual_document;
mod world;

use std::time::Duration;

use tower_lsp::LspService;

use guard::Guard;
use log::Log;
use server::Server;
use transport::{Input, Output};

/// Threads that answer requests. Most of them only wait for the analysis that
/// another does: an editor asks for ten things at once of each document that it
/// shows, and one large document must not keep all threads waiting.
const THREADS: usize = 256;

/// How long answers are worked out for a client that has closed its stream.
const GRACE: Duration = Duration::from_secs(2);

/// Serves one client on the standard streams until it says `exit` or is gone.
/// Ends the process: with 0 if the client asked for a shutdown before, else
/// with 1, as the protocol wants it.
pub fn serve() -> std::io::Result<std::convert::Infallible> {
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(1)
        .max_blocking_threads(THREADS)
        .thread_keep_alive(Duration::from_secs(2))
        .enable_time()
        .build()?;
    let output = Output::start();
    let (input, ended) = Input::start(output.clone());
    let log = Log::start();
    let told = log.clone();
    std::panic::set_hook(Box::new(move |panic| told.line(panic.to_string())));
    let end = server::End::default();
    runtime.block_on(async {
        let (service, socket) = Server::service(end.clone(), log, output.clone());
        let server = tower_lsp::Server::new(input, output.clone(), socket);
        let serving = server
            .concurrency_level(usize::MAX)
            .serve(Guard::<LspService<Server>>(service));
        tokio::select! {
            () = serving => {}
            () = async {
                // It is never sent, so this is the end of the stream.
                let _ = ended.await;
                tokio::time::sleep(GRACE).await;
            } => {}
        }
    });
    output.finish();
    // A thread may still wait for standard input; only this ends it.
    std::process::exit(end.status());
}
