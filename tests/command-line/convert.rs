//! The spec beside a ladder: the same wherever it is made, and never lost.

use crate::gradus;

const LADDER: &str = "fixtures/neutralization/neutralization.ladder";

fn ladder() -> String {
    std::fs::read_to_string(end_to_end::path(LADDER)).expect("a fixture")
}

#[test]
fn the_same_ladder_gives_the_same_bytes_in_every_folder_under_every_name() {
    let arguments = ["--accept", "handover", "--initial", "v1"];
    let mut specs = Vec::new();
    for name in ["tank.ladder", "a folder/deep/Förderer.ladder", "./x.y.txt"] {
        for absolute in [false, true] {
            let gradus = gradus();
            let path = gradus.write(name, ladder());
            let path = path.to_str().expect("a readable path");
            let file = if absolute { path } else { name };
            let ended = gradus.run(&[&["convert", file], &arguments[..]].concat());
            assert_eq!(ended.status, Some(0), "{}", ended.aside);
            let spec = std::path::Path::new(name).with_extension("grafcet");
            specs.push(gradus.read(spec.to_str().expect("a readable path")));
        }
    }
    specs.dedup();
    assert_eq!(specs.len(), 1);
}

#[test]
fn answers_are_the_same_on_every_run() {
    let gradus = gradus();
    gradus.write("tank.ladder", ladder());
    for arguments in [
        &["conditions", "--json", "tank.ladder"][..],
        &["suggest", "--json", "tank.ladder"],
        &["suggest", "tank.ladder"],
        &[
            "convert",
            "--json",
            "-o",
            "-",
            "--accept",
            "all",
            "tank.ladder",
        ],
    ] {
        let first = gradus.run(arguments);
        assert_eq!(first.status, Some(0), "{}", first.aside);
        assert_eq!(first.answer, gradus.run(arguments).answer, "{arguments:?}");
    }
}

#[test]
fn a_spec_that_says_everything_already_is_not_touched() {
    let gradus = gradus();
    gradus.write("tank.ladder", ladder());
    gradus.run(&["convert", "tank.ladder", "--accept", "handover"]);
    let path = gradus.folder().join("tank.grafcet");
    let modified = || {
        path.metadata()
            .and_then(|data| data.modified())
            .expect("a time")
    };
    let before = modified();
    for more in [
        &[][..],
        &["--accept", "none"],
        &["--accept", "handover"],
        &["--renew"],
    ] {
        let ended = gradus.run(&[&["convert", "tank.ladder"], more].concat());
        assert!(
            ended.answer.contains("tank.grafcet: unchanged"),
            "{}",
            ended.answer
        );
        assert_eq!(modified(), before, "{more:?}");
    }
}

#[test]
fn line_ends_and_the_byte_order_mark_of_a_spec_stay() {
    let gradus = gradus();
    gradus.write("tank.ladder", ladder());
    gradus.run(&["convert", "tank.ladder"]);
    let windows = format!(
        "\u{feff}{}",
        gradus.read("tank.grafcet").replace('\n', "\r\n")
    );
    gradus.write("tank.grafcet", windows);
    gradus.run(&["convert", "tank.ladder", "--accept", "v1->v2&h&m"]);
    let after = gradus.read("tank.grafcet");
    assert!(after.starts_with('\u{feff}'));
    assert!(after.ends_with("//! accept v1 -> v2 & h & m\r\n"));
    assert!(!after.replace("\r\n", "").contains('\n'));
}

#[test]
fn a_decision_written_by_hand_says_what_accepting_says() {
    // Decisions are a paragraph of their own.
    for (pair, before, gap) in [
        ("v1->v2&h&m", None, "\n"),
        ("v4->m", Some("v1->v2&h&m"), ""),
    ] {
        let gradus = gradus();
        gradus.write("tank.ladder", ladder());
        gradus.run(&["convert", "tank.ladder"]);
        if let Some(before) = before {
            gradus.run(&["convert", "tank.ladder", "--accept", before]);
        }
        let undecided = gradus.read("tank.grafcet");
        gradus.run(&["convert", "tank.ladder", "--accept", pair]);
        let accepted = gradus.read("tank.grafcet");
        assert_ne!(accepted, undecided);
        let decision = accepted.lines().last().expect("a decision");
        gradus.write("tank.grafcet", format!("{undecided}{gap}{decision}\n"));
        gradus.run(&["convert", "tank.ladder"]);
        assert_eq!(gradus.read("tank.grafcet"), accepted, "{decision}");
    }
}

#[test]
fn no_spec_however_damaged_makes_it_panic_or_lose_a_line() {
    let gradus = gradus();
    gradus.write("tank.ladder", ladder());
    gradus.run(&["convert", "tank.ladder", "--accept", "handover"]);
    let whole = gradus.read("tank.grafcet");
    let lines: Vec<&str> = whole.lines().collect();
    for (at, line) in lines.iter().enumerate() {
        if !line.contains("|-") {
            continue;
        }
        // One rule cut short at a time.
        let cut = &line[..line.find("|-").unwrap_or(0) + 1];
        let mut damaged = lines.clone();
        damaged[at] = cut;
        gradus.write("tank.grafcet", damaged.join("\n") + "\n");
        let ended = gradus.run(&["convert", "tank.ladder", "--accept", "v4->m"]);
        assert_eq!(ended.status, Some(1), "{}", ended.aside);
        let after = gradus.read("tank.grafcet");
        assert!(after.lines().any(|line| line == cut), "{cut}");
    }
}

#[test]
fn of_a_large_plant_a_few_states_are_listed_and_the_others_counted() {
    let gradus = gradus();
    let rungs = (0..30).map(|at| {
        let (before, after) = ((at + 29) % 30, (at + 1) % 30);
        format!("rung: (q{before}*s{at} + q{at}) * /q{after} -> q{at}\n")
    });
    gradus.write("chain.ladder", rungs.collect::<String>());
    let listed = |accept: &str| {
        let ended = gradus.run(&[
            "convert",
            "chain.ladder",
            "--accept",
            accept,
            "--initial",
            "q0",
        ]);
        assert_eq!(ended.status, Some(0), "{}", ended.aside);
        ended.answer
    };
    let open = listed("none");
    // Besides the twenty stands the one in which the sequence starts.
    assert_eq!(open.matches("  open      -> ").count(), 21, "{open}");
    let rest = "\n9 other states with open suggestions: `gradus suggest` lists them\n";
    assert!(open.contains(rest), "{open}");
    // What is decided is all there.
    let accepted = listed("handover");
    assert_eq!(
        accepted.matches("  accepted  -> ").count(),
        60,
        "{accepted}"
    );
    assert!(!accepted.contains("other state"), "{accepted}");
}
