//! Ctrl-C.

use std::process::{Command, Stdio};
use std::time::Duration;

use end_to_end::Ended;

use crate::gradus;

#[test]
fn ctrl_c_ends_a_command_that_waits_for_its_input_with_130() {
    let gradus = gradus();
    let mut child = gradus
        .command(&["check", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the executable");
    let input = child.stdin.take();
    // Long enough for it to have begun waiting.
    std::thread::sleep(Duration::from_millis(300));
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .expect("`kill`");
    assert!(sent.success());
    let ended = Ended::of(child);
    drop(input);
    assert_eq!((ended.status, ended.answer.as_str()), (Some(130), ""));
}
