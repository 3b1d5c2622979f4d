//! Where answers go when nobody, or nothing, can take them.

use std::fs::File;
use std::process::Stdio;

use end_to_end::Ended;

use crate::gradus;

#[test]
fn an_answer_that_nobody_reads_on_ends_quietly() {
    let gradus = gradus();
    let mut child = gradus
        .command(&["explain"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the executable");
    drop(child.stdout.take());
    let ended = Ended::of(child);
    assert_eq!((ended.status, ended.aside.as_str()), (Some(0), ""));
}

#[cfg(target_os = "linux")]
#[test]
fn an_answer_that_cannot_be_written_is_told() {
    let gradus = gradus();
    let full = File::options().write(true).open("/dev/full");
    let child = gradus
        .command(&["explain"])
        .stdout(full.expect("a full disk"))
        .stderr(Stdio::piped())
        .spawn()
        .expect("the executable");
    let ended = Ended::of(child);
    assert_eq!(ended.status, Some(2));
    assert!(
        ended.aside.contains("the answer cannot be written"),
        "{}",
        ended.aside
    );
}

#[test]
fn json_and_sarif_are_one_document_each_and_the_same_on_every_run() {
    let gradus = gradus();
    gradus.write("a.txt", "no ladder");
    gradus.write("b.l5x", "\u{feff}neither");
    for form in ["json", "sarif"] {
        let arguments = ["check", "--format", form, "a.txt", "b.l5x", "missing"];
        let first = gradus.run(&arguments);
        serde_json::from_str::<serde_json::Value>(&first.answer).expect("one document");
        assert_eq!(first.answer, gradus.run(&arguments).answer);
    }
}

#[test]
fn no_bytes_at_all_make_it_panic() {
    let gradus = gradus();
    for input in [
        &b""[..],
        b"\0",
        b"\xff\xfe<\0",
        b"<",
        b"\xef\xbb\xbf",
        b"\x1b[2J",
    ] {
        let ended = gradus.run_with(&["check", "-"], input);
        assert_eq!(ended.status, Some(1), "{input:?}: {}", ended.aside);
    }
}
