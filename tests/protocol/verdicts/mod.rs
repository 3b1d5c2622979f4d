//! Verdicts through the protocol: proofs in the background, what is said of them,
//! and what can be done about a difference.

mod actions;
mod background;
mod saying;

use end_to_end::lsp::{Client, Profile};
use serde_json::{Value, json};

use crate::scenarios::{LADDER, SPEC};

/// The spec when the tank overflows while somebody does not press start.
fn overflowing() -> String {
    SPEC.replacen("Xv1*ls2", "Xv1*ls2*s", 1)
}

/// A client of this kind with ladder and spec open.
fn tank_like(profile: Profile, spec: &str) -> Client {
    let mut client = crate::client_like(profile);
    client.open("tank.ladder", LADDER);
    client.open("tank.grafcet", spec);
    client
}

/// Waits until the status says that this is known of the proof; what it says.
fn proof(client: &mut Client, verdict: &str) -> Value {
    loop {
        let status = client.notification("gradus/status");
        if status["proof"]["verdict"] == verdict {
            return status["proof"]["message"].clone();
        }
    }
}

/// What the command answers.
fn verify(client: &mut Client) -> Value {
    let argument = json!({ "uri": client.uri("tank.grafcet") });
    let answer = crate::commands::ask(client, "gradus.verify", argument);
    answer.expect("no refusal").expect("an answer")
}
