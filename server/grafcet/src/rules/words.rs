/// The word that begins a list of declarations or marks.
///
/// The order is that of the sections of a canonical text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Word {
    Step,
    Macro,
    Enclosing,
    Transition,
    Input,
    Output,
    Internal,
    Instance,
    Marking,
    Activation,
}

const WORDS: [(&str, Word); 10] = [
    ("Step", Word::Step),
    ("Macro", Word::Macro),
    ("Enclosing", Word::Enclosing),
    ("Transition", Word::Transition),
    ("Input", Word::Input),
    ("Output", Word::Output),
    ("Internal", Word::Internal),
    ("Instance", Word::Instance),
    ("Marking", Word::Marking),
    ("Activation", Word::Activation),
];

impl Word {
    /// The word that `text` writes, in any case.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let mut all = WORDS.iter();
        all.find(|(word, _)| word.eq_ignore_ascii_case(text))
            .map(|(_, word)| *word)
    }

    /// As it is written.
    pub(crate) fn text(self) -> &'static str {
        let mut all = WORDS.iter();
        all.find(|(_, word)| *word == self)
            .map_or("", |(text, _)| text)
    }

    /// Whether what it declares belongs to the whole spec, whatever part the
    /// text is in.
    pub(crate) fn is_global(self) -> bool {
        matches!(
            self,
            Self::Input | Self::Output | Self::Internal | Self::Instance
        )
    }

    /// Whether it declares a step.
    pub(crate) fn declares_step(self) -> bool {
        matches!(self, Self::Step | Self::Macro | Self::Enclosing)
    }

    /// Whether it declares a variable.
    pub(crate) fn declares_variable(self) -> bool {
        matches!(self, Self::Input | Self::Output | Self::Internal)
    }
}

/// The word that begins a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PartWord {
    Partial,
    Expansion,
    Reusable,
}

impl PartWord {
    pub(crate) fn parse(text: &str) -> Option<Self> {
        [Self::Partial, Self::Expansion, Self::Reusable]
            .into_iter()
            .find(|word| word.text().eq_ignore_ascii_case(text))
    }

    pub(crate) fn text(self) -> &'static str {
        match self {
            Self::Partial => "Partial",
            Self::Expansion => "Expansion",
            Self::Reusable => "Reusable",
        }
    }
}

/// A section: which kind of rules follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Section {
    Transitions,
    Steps,
    Environment,
    Never,
}

impl Section {
    pub(crate) const ALL: [Self; 4] = [
        Self::Transitions,
        Self::Steps,
        Self::Environment,
        Self::Never,
    ];

    pub(crate) fn parse(text: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|section| section.text().eq_ignore_ascii_case(text))
    }

    pub(crate) fn text(self) -> &'static str {
        match self {
            Self::Transitions => "Transitions",
            Self::Steps => "Steps",
            Self::Environment => "Environment",
            Self::Never => "Never",
        }
    }

    /// Whether its rules belong to the whole spec, whatever part the text is
    /// in.
    pub(crate) fn is_global(self) -> bool {
        matches!(self, Self::Environment | Self::Never)
    }
}

/// The word that names the grafcet.
pub(crate) const GRAFCET: &str = "Grafcet";

/// What begins a decision line.
pub(crate) const DECISION: &str = "//!";

/// The small words inside statements. A name that is one of these is written
/// in quotes, so that it can never be taken for the word.
const SMALL: [&str; 13] = [
    "activation",
    "after",
    "deactivation",
    "fall",
    "for",
    "force",
    "INIT",
    "of",
    "on",
    "reset",
    "rise",
    "set",
    "until",
];

/// Whether `name` is a word of the rule text.
pub(crate) fn is_reserved(name: &str) -> bool {
    is_leading(name) || SMALL.iter().any(|word| word.eq_ignore_ascii_case(name))
}

/// Whether `name` can begin a declaration.
pub(crate) fn is_leading(name: &str) -> bool {
    Word::parse(name).is_some()
        || PartWord::parse(name).is_some()
        || name.eq_ignore_ascii_case(GRAFCET)
}
