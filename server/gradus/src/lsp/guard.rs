//! A handler that panics answers with an error; the server goes on.
//!
//! The protocol library runs all handlers on one task, which a panic would end.

use std::any::Any;
use std::panic::AssertUnwindSafe;
use std::task::{Context, Poll};

use futures_util::FutureExt;
use futures_util::future::BoxFuture;
use tower::Service;
use tower_lsp::jsonrpc::{Error, Request, Response};

use super::fault;

/// A service whose panics are answers.
#[derive(Debug)]
pub struct Guard<S>(pub S);

impl<S> Service<Request> for Guard<S>
where
    S: Service<Request, Response = Option<Response>>,
    S::Future: Send + 'static,
{
    type Response = Option<Response>;
    type Error = S::Error;
    type Future = BoxFuture<'static, Result<Option<Response>, S::Error>>;

    fn poll_ready(&mut self, context: &mut Context<'_>) -> Poll<Result<(), S::Error>> {
        self.0.poll_ready(context)
    }

    fn call(&mut self, request: Request) -> Self::Future {
        let id = request.id().cloned();
        let method = request.method().to_owned();
        let handler = self.0.call(request);
        Box::pin(async move {
            let guarded = async {
                fault::forced(&method);
                handler.await
            };
            match AssertUnwindSafe(guarded).catch_unwind().await {
                // The library passes over what begins with `$/`, requests too.
                Ok(Ok(None)) if method.starts_with("$/") => {
                    let error = Error::method_not_found();
                    Ok(id.map(|id| Response::from_error(id, error)))
                }
                Ok(answer) => answer,
                Err(panic) => {
                    let error = internal(&format!("{method}: {}", reason(&*panic)));
                    Ok(id.map(|id| Response::from_error(id, error)))
                }
            }
        })
    }
}

/// What a panic says.
pub fn reason(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("no reason given")
}

/// The error that tells of a fault of the server itself.
pub fn internal(what: &str) -> Error {
    Error {
        message: format!("a fault in gradus, please report it: {what}").into(),
        ..Error::internal_error()
    }
}
