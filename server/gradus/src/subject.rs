//! What a scenario is run on: the ladder and the spec that it names, or those
//! beside it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use grafcet::Grafcet;
use ladder::{Format, Program};
use logic::Cancel;
use recovery::simulation::{self, Subject};
use scenario::{FileName, Scenario};
use source::{Diagnostic, Span, codes};

use crate::command::check::against::beside;
use crate::file;
use crate::input;
use crate::io::is_standard_input;
use ide::language;

/// A ladder, a spec, or both, and where they came from.
#[derive(Default)]
pub struct Plant {
    /// The ladder.
    pub ladder: Option<(PathBuf, Arc<Program>)>,
    /// The grafcet of the spec.
    pub spec: Option<(PathBuf, Grafcet)>,
}

/// Why a file cannot be a part of a plant.
pub enum Misfit {
    /// There is such a part already.
    Second(&'static str),
    /// It holds neither a ladder nor a spec.
    Other,
}

impl Plant {
    /// What a scenario runs on.
    pub fn subject(&self) -> Subject<'_> {
        Subject {
            ladder: self.ladder.as_ref().map(|(_, program)| &**program),
            grafcet: self.spec.as_ref().map(|(_, grafcet)| grafcet),
        }
    }

    /// Whether there is nothing to run.
    pub fn is_empty(&self) -> bool {
        self.ladder.is_none() && self.spec.is_none()
    }

    /// Adds what `bytes` hold, the contents of the file at `path`. Gives what
    /// was found in its text.
    pub fn add(&mut self, path: &Path, bytes: &[u8]) -> Result<Vec<Diagnostic>, Misfit> {
        match language::of(bytes) {
            language::File::Spec(_) if self.spec.is_some() => Err(Misfit::Second("spec")),
            language::File::Spec(text) => {
                let reading = grafcet::read(text);
                self.spec = Some((path.to_owned(), reading.spec.grafcet));
                Ok(reading.diagnostics)
            }
            language::File::Ladder(bytes) => {
                let reading = ladder::read(bytes);
                if reading.program.format == Format::Unknown {
                    return Err(Misfit::Other);
                }
                if self.ladder.is_some() {
                    return Err(Misfit::Second("ladder"));
                }
                self.ladder = Some((path.to_owned(), reading.program));
                Ok(reading.diagnostics)
            }
            language::File::Scenario(_) => Err(Misfit::Other),
        }
    }

    /// Adds the only ladder in the folder of `path`, with the spec beside it.
    fn add_only_ladder(&mut self, path: &Path) {
        let ladder = input::only_ladder(path, |path| {
            let mut plant = Self::default();
            plant.add(path, &file::read(path).ok()?).ok()?;
            plant.ladder
        });
        let Some(ladder) = ladder else {
            return;
        };
        let spec = ladder.0.with_extension("grafcet");
        self.ladder = Some(ladder);
        if let Ok(bytes) = file::read(&spec) {
            // What is no spec is no part.
            let _ = self.add(&spec, &bytes);
        }
    }

    /// The files of the plant as a scenario at `path` names them: those that lie
    /// in its folder.
    pub fn files_seen_from(&self, path: &Path) -> Vec<FileName> {
        let ladder = self.ladder.iter().map(|(path, _)| path);
        let paths = ladder.chain(self.spec.iter().map(|(path, _)| path));
        paths
            .filter(|file| file.parent() == path.parent() && !is_standard_input(file))
            .filter_map(|file| file.file_name()?.to_str())
            .map(|name| FileName {
                path: name.into(),
                span: Span::default(),
            })
            .collect()
    }

    /// What the scenario at `path` runs on: what it names, and what is wrong
    /// with that; if it names nothing, what lies beside it, or else the only
    /// ladder in its folder with its spec.
    pub fn of(path: &Path, scenario: &Scenario) -> (Self, Vec<Diagnostic>) {
        let mut plant = Self::default();
        let mut found = Vec::new();
        if scenario.files.is_empty() {
            for other in beside(path) {
                if let Ok(bytes) = file::read(&other) {
                    // A second one of a kind has an ending that counts less.
                    let _ = plant.add(&other, &bytes);
                }
            }
            if plant.is_empty() && !is_standard_input(path) {
                plant.add_only_ladder(path);
            }
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        for named in &scenario.files {
            let other = folder.join(&*named.path);
            let trouble = match file::read(&other) {
                Err(reason) => Some(reason.diagnostic().message),
                Ok(bytes) => plant
                    .add(&other, &bytes)
                    .err()
                    .map(|misfit| misfit.sentence()),
            };
            found.extend(trouble.map(|trouble| unreadable(&named.path, named.span, &trouble)));
        }
        (plant, found)
    }
}

impl Misfit {
    /// What is wrong, as a message says it behind the name of the file.
    pub fn sentence(&self) -> String {
        match self {
            Self::Second(kind) => format!("this is a second {kind}, and a scenario runs on one"),
            Self::Other => "this holds neither a ladder nor a spec".to_owned(),
        }
    }
}

/// A file that a scenario names and that cannot be a part of what it runs on.
pub fn unreadable(name: &str, span: Span, trouble: &str) -> Diagnostic {
    let message = format!("{name}: {trouble}");
    Diagnostic::new(codes::FILE_UNREADABLE, span, message)
        .help("the path is seen from the folder of the scenario")
}

/// What there is to say about the scenario at `path`, run on `ladder`, or else
/// on what it names or what lies beside it.
pub fn about_scenario(
    path: &Path,
    text: &str,
    ladder: Option<&Arc<Program>>,
    cancel: &Cancel,
) -> Vec<Diagnostic> {
    let reading = scenario::read(text);
    let scenario = &reading.scenario;
    let mut found = reading.diagnostics;
    let plant = match ladder {
        Some(program) => Plant {
            ladder: Some((PathBuf::new(), Arc::clone(program))),
            spec: None,
        },
        None => {
            let (plant, trouble) = Plant::of(path, scenario);
            found.extend(trouble);
            plant
        }
    };
    let subject = plant.subject();
    if !plant.is_empty() {
        found.extend(simulation::unknown_names(scenario, subject));
    }
    if found.is_empty() && !plant.is_empty() {
        let simulation = simulation::simulate(scenario, subject, cancel);
        found.extend(simulation::findings(scenario, &simulation));
    }
    found.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    found
}
