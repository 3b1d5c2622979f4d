//! What holds for every spec and every text.

mod random;

use grafcet::{Spec, format, read, rewrite, write};
use proptest::prelude::*;
use random::{specs, texts};

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// What is written reads back as it was, and writes the same again.
    #[test]
    fn writing_and_reading_are_inverse(spec in specs()) {
        let text = write(&spec);
        let reading = read(&text);
        prop_assert_eq!(syntax_errors(&text), Vec::<String>::new(), "{}", text);
        prop_assert!(reading.spec.says_the_same(&spec), "{}\n{:#?}", text, reading.spec);
        prop_assert_eq!(write(&reading.spec), text);
    }

    /// Accepting nothing new changes nothing.
    #[test]
    fn rewriting_to_what_a_text_says_leaves_it_as_it_is(text in texts()) {
        let spec = read(&text).spec;
        prop_assert_eq!(rewrite(&text, &spec), text);
    }

    /// Whatever stood there before, the text says what it was made to say.
    #[test]
    fn a_rewritten_text_says_what_was_wanted(text in texts(), target in specs()) {
        check_rewrite(&text, &target)?;
    }

    /// The same with a target that has much in common with the text.
    #[test]
    fn a_text_follows_small_changes(text in texts(), removed in 0usize..40, spec in specs()) {
        let mut target = read(&text).spec;
        random::change(&mut target, removed, &spec);
        check_rewrite(&text, &target)?;
    }

    /// Formatting changes the layout and nothing else.
    #[test]
    fn formatting_keeps_what_is_said(text in texts()) {
        let formatted = format(&text).text;
        prop_assert_eq!(read(&formatted).spec, read(&text).spec, "{}", formatted);
        prop_assert_eq!(&format(&formatted).text, &formatted);
        prop_assert_eq!(comments(&formatted), comments(&text));
        let broken = random::broken_lines(&text);
        prop_assert_eq!(random::broken_lines(&formatted), broken);
    }

    /// Any text at all is read, and every place lies in it.
    #[test]
    fn reading_never_fails(text in "\\PC{0,80}", more in random::sign_soup()) {
        for text in [&text, &more] {
            let reading = read(text);
            let spans = reading.diagnostics.iter().map(|diagnostic| diagnostic.span);
            let names = reading.places.mentions.iter().map(|mention| mention.span);
            for span in spans.chain(names) {
                prop_assert!(text.get(span.range()).is_some());
            }
            prop_assert_eq!(&rewrite(text, &reading.spec), text);
            let formatted = format(text).text;
            prop_assert_eq!(&format(&formatted).text, &formatted);
        }
    }

    /// Anything at all can be made to say what is wanted.
    #[test]
    fn any_text_can_be_rewritten(text in random::sign_soup(), target in specs()) {
        check_rewrite(&text, &target)?;
    }
}

fn check_rewrite(text: &str, target: &Spec) -> Result<(), TestCaseError> {
    let result = rewrite(text, target);
    let found = read(&result).spec;
    prop_assert!(
        found.says_the_same(target),
        "from:\n{text}\n-- to:\n{result}\n-- wanted:\n{}\n-- found:\n{}",
        write(target),
        write(&found)
    );
    prop_assert_eq!(&rewrite(&result, target), &result);
    for line in random::broken_lines(text) {
        prop_assert!(
            result.contains(&line),
            "lost {line:?}:\n{text}\n--\n{result}"
        );
    }
    Ok(())
}

fn syntax_errors(text: &str) -> Vec<String> {
    let found = read(text).diagnostics.into_iter();
    let errors = found.filter(|found| {
        let counts_arguments = found.message.contains(" are given");
        found.code == source::codes::SPEC_SYNTAX && !counts_arguments
    });
    errors.map(|found| found.message).collect()
}

/// The words of all comments.
fn comments(text: &str) -> Vec<String> {
    let lines = text.split(['\n', '\r']);
    let comments = lines.filter_map(|line| Some(line.split_once("//")?.1));
    comments
        .flat_map(str::split_whitespace)
        .filter(|word| *word != "//")
        .map(|word| word.replace('"', ""))
        .collect()
}
