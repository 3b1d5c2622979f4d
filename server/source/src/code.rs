use crate::Severity;

/// The identity of a kind of finding: `G` and four digits, stable for ever.
///
/// The first digit says what is read: 1 a ladder's text, 2 a ladder's meaning,
/// 3 a spec, 4 files, 5 a scenario.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Code(u16);

impl Code {
    /// The page of the documentation that explains the finding, in Markdown.
    /// `gradus explain` prints it.
    pub fn page(self) -> &'static str {
        self.entry().page
    }

    /// The usual severity of the finding.
    pub fn severity(self) -> Severity {
        self.entry().severity
    }

    /// A few words that name the finding, lower case.
    pub fn title(self) -> &'static str {
        self.entry().title
    }

    /// The code written as `text`, such as `G2001` in either case.
    pub fn parse(text: &str) -> Option<Self> {
        let digits = text.strip_prefix(['G', 'g'])?;
        let number = digits.parse().ok()?;
        codes::ALL.iter().copied().find(|code| code.0 == number)
    }

    fn entry(self) -> &'static codes::Entry {
        let at = codes::TABLE
            .binary_search_by_key(&self.0, |entry| entry.number)
            .unwrap_or(0);
        &codes::TABLE[at]
    }
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "G{:04}", self.0)
    }
}

impl std::fmt::Debug for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{self}")
    }
}

/// Every kind of finding, in the order of its number.
///
/// To add one: a line in the table below and a page under `docs/diagnostics`.
pub mod codes {
    use super::{Code, Severity};

    pub(super) struct Entry {
        pub(super) number: u16,
        pub(super) severity: Severity,
        pub(super) title: &'static str,
        pub(super) page: &'static str,
    }

    macro_rules! table {
        ($($name:ident = $number:literal, $severity:ident, $title:literal;)*) => {
            $(
                #[doc = $title]
                pub const $name: Code = Code($number);
            )*
            /// All of them.
            pub const ALL: &[Code] = &[$($name),*];
            pub(super) const TABLE: &[Entry] = &[$(
                Entry {
                    number: $number,
                    severity: Severity::$severity,
                    title: $title,
                    page: include_str!(concat!(
                        env!("CARGO_MANIFEST_DIR"),
                        "/../../docs/diagnostics/G", stringify!($number), ".md"
                    )),
                }
            ),*];
        };
    }

    table! {
        NOT_A_PROGRAM = 1001, Error, "not a ladder program";
        STORED_ELSEWHERE = 1002, Error, "a pointer, not a program";
        ENCODING = 1003, Error, "text is not UTF-8";
        XML_SYNTAX = 1004, Error, "XML is not well formed";
        XML_REFUSED = 1005, Error, "XML construct refused";
        CUT_SHORT = 1006, Error, "file ends too early";
        TOO_LARGE_FILE = 1007, Error, "file too large";
        LADDER_SYNTAX = 1101, Error, "rung notation not understood";
        DECLARED_TWICE = 1102, Error, "name declared twice";
        NEUTRAL_TEXT_SYNTAX = 1201, Error, "neutral text not understood";
        PENDING_EDIT = 1202, Information, "pending edit not counted";
        PROTECTED = 1203, Warning, "protected content";
        OTHER_LANGUAGE = 1204, Information, "body in another language";
        MISSING_ROUTINE = 1205, Warning, "called routine is not in the file";
        DANGLING_CONNECTION = 1301, Error, "connection leads nowhere";
        RUNG_WITHOUT_OUTPUT = 1302, Warning, "rung without an output";
        NETWORK_LOOP = 1303, Error, "power flows in a circle";
        NAMELESS = 1304, Warning, "element without a variable";
        UNKNOWN_BOX = 2001, Warning, "box not known";
        DOUBLE_COIL = 2002, Warning, "coil driven from several rungs";
        READ_BEFORE_WRITTEN = 2003, Hint, "read above the rung that writes it";
        LATCH_WITHOUT_UNLATCH = 2004, Hint, "set but never reset";
        UNLATCH_WITHOUT_LATCH = 2005, Hint, "reset but never set";
        NEVER_WRITTEN = 2006, Hint, "neither written nor declared as an input";
        ALWAYS_TRUE = 2007, Warning, "condition always true";
        ALWAYS_FALSE = 2008, Warning, "condition always false";
        FALLS_IN_ITSELF = 2009, Warning, "rung falls in its own coil";
        INTERLOCK_NEVER_RELEASES = 2010, Warning, "interlock that can never release";
        UNREACHABLE_RUNG = 2011, Warning, "rung is never solved";
        CALL_NOT_FOLLOWED = 2012, Warning, "call not followed";
        TOO_LARGE = 2013, Warning, "condition too large";
        BACKWARD_JUMP = 2014, Warning, "jump backwards";
        WRITTEN_AS_A_WORD = 2015, Hint, "bits written through their word";
        SPEC_SYNTAX = 3001, Error, "rule text not understood";
        SPEC_UNDECLARED = 3002, Error, "name not declared";
        SPEC_DECLARED_TWICE = 3003, Error, "name declared twice";
        SPEC_NO_INITIAL_STEP = 3004, Warning, "no initial step";
        TRANSITION_WITHOUT_RULE = 3005, Warning, "transition without a rule";
        RULE_NOT_SUPPORTED = 3101, Warning, "rule that the ladder no longer supports";
        STATE_GONE = 3102, Warning, "state is no longer in the ladder";
        DECISION_UNKNOWN = 3103, Warning, "decision about an unknown state";
        DECISION_SYNTAX = 3104, Warning, "decision not understood";
        SPEC_DIFFERS = 3201, Warning, "spec does not do what the ladder does";
        PROPERTY_VIOLATED = 3202, Warning, "property does not hold";
        VERDICT_UNKNOWN = 3203, Information, "not known whether ladder and spec do the same";
        NOT_VERIFIED = 3204, Information, "ladder and spec cannot be compared";
        FILE_UNREADABLE = 4001, Error, "file cannot be read";
        SETTINGS_SYNTAX = 4101, Error, "settings file not understood";
        SETTING_UNKNOWN = 4102, Warning, "setting not known";
        SETTING_WRONG = 4103, Warning, "setting of a wrong kind";
        SCENARIO_SYNTAX = 5001, Error, "scenario not understood";
        SCENARIO_NAME_UNKNOWN = 5002, Error, "name that nothing in the run knows";
        EXPECTATION_FAILED = 5003, Error, "expectation not met";
        SCENARIO_NOT_RUN = 5004, Error, "scenario cannot be run to its end";
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_has_a_page_that_begins_with_its_number_and_title() {
        for code in codes::ALL {
            let heading = format!("# {code}: {}\n", code.title());
            assert!(code.page().starts_with(&heading), "page of {code}");
            assert_eq!(Code::parse(&code.to_string()), Some(*code));
        }
    }
}
