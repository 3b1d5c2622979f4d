//! Words that hovers use, each with the page that explains it.
//!
//! The pages are documents under `docs/terms`, taken in when this is compiled:
//! what an editor shows is what stands there.

macro_rules! terms {
    ($($name:ident = $file:literal, $words:literal;)*) => {
        /// A word that hovers use.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Term {
            $(#[doc = $words] $name,)*
        }

        impl Term {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$name),*];

            /// What its page is called, without an ending.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$name => $file,)*
                }
            }

            /// How people say it.
            pub fn words(self) -> &'static str {
                match self {
                    $(Self::$name => $words,)*
                }
            }

            /// The page that explains it, in Markdown.
            pub fn page(self) -> &'static str {
                match self {
                    $(Self::$name => include_str!(concat!(
                        env!("CARGO_MANIFEST_DIR"),
                        "/../../docs/terms/", $file, ".md"
                    )),)*
                }
            }
        }
    };
}

terms! {
    State = "state", "state";
    SealIn = "seal-in", "seal-in";
    Latch = "latch", "latch";
    Persistent = "persistent", "persistent";
    NonPersistent = "non-persistent", "non-persistent";
    Oscillating = "oscillating", "oscillating";
    StoredOutput = "stored-output", "stored output";
    Auxiliary = "auxiliary", "auxiliary coil";
    StepRegister = "step-register", "step register";
    Interlock = "interlock", "interlock";
    Opaque = "opaque", "opaque";
    AtRest = "at-rest", "at rest";
    Succession = "succession", "succession";
    Step = "step", "step";
    Transition = "transition", "transition";
}

impl Term {
    /// The term whose page is called `name`.
    pub fn called(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|term| term.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_page_begins_with_its_term() {
        for term in Term::ALL {
            let heading = term.page().lines().next().expect("a heading");
            assert_eq!(heading.to_lowercase(), format!("# {}", term.words()));
            assert_eq!(Term::called(term.name()), Some(*term));
        }
    }
}
