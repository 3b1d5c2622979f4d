use logic::Name;

/// Why the value of a variable after a scan is not known from what was before
/// it and the inputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unsaid {
    /// Its condition is too large.
    TooLarge,
    /// One of its rungs is solved several times in a scan, or how often is not
    /// known.
    Repeated,
    /// An edge in a rung that is not always solved.
    SkippedEdge,
    /// An edge of something that several rungs write, or of the last value of
    /// a number, a timer or a box.
    Edge(Name),
    /// One rung looks at it while it is being written.
    Between(Name),
    /// It compares a number of this scan with one of the last.
    Mixed(Name),
    /// A box or a calculation writes it.
    Written,
}

impl Unsaid {
    /// The reason in words, to go on after the name of a variable.
    pub fn words(&self) -> String {
        match self {
            Self::TooLarge => "its condition is too large".into(),
            Self::Repeated => "a rung of it may be solved several times in a scan".into(),
            Self::SkippedEdge => "it sees an edge in a rung that is not always solved".into(),
            Self::Edge(name) => {
                format!("it sees an edge of `{name}` before the scan has written it to the end")
            }
            Self::Between(name) => {
                format!("it sees `{name}` while other rungs are still writing it")
            }
            Self::Mixed(name) => {
                format!("it compares `{name}` with a number of another scan")
            }
            Self::Written => "a box or a calculation writes it too".into(),
        }
    }
}
