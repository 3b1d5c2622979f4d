//! A progress line for work that takes long.
//!
//! It appears on standard error, only if that is a terminal, and only after
//! half a second: short work shows nothing that would flicker by. Dropping it
//! clears the line.

use std::io::IsTerminal;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Work shorter than this shows nothing.
const PATIENCE: Duration = Duration::from_millis(500);

/// The time between two pictures of the line.
const BEAT: Duration = Duration::from_millis(100);

/// How far some work has come.
pub struct Progress {
    bar: ProgressBar,
    done: Option<Sender<()>>,
    curtain: Option<JoinHandle<()>>,
}

impl Progress {
    /// Begins work of `total` parts, such as files; `activity` says what is
    /// done to them: "Checking".
    pub fn begin(activity: &'static str, total: usize) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total as u64), ProgressDrawTarget::hidden())
            .with_style(style("{prefix} {bar:24} {pos}/{len} {wide_msg}"))
            .with_prefix(activity);
        Self::show(bar)
    }

    /// Begins work on one thing, of which nobody knows how long it takes.
    pub fn of_one(activity: &'static str, name: &str) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden())
            .with_style(style("{spinner} {prefix} {wide_msg}"))
            .with_prefix(activity)
            .with_message(name.to_owned());
        Self::show(bar)
    }

    fn show(bar: ProgressBar) -> Self {
        if !std::io::stderr().is_terminal() {
            return Self {
                bar,
                done: None,
                curtain: None,
            };
        }
        let (done, ended) = mpsc::channel();
        let shown = bar.clone();
        let curtain = std::thread::spawn(move || show_later(&shown, &ended));
        Self {
            bar,
            done: Some(done),
            curtain: Some(curtain),
        }
    }

    /// Says which part the work is at now; the parts before it are done.
    pub fn at(&self, part: usize, name: &str) {
        self.bar.set_position(part as u64);
        self.bar.set_message(name.to_owned());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.done = None;
        if let Some(curtain) = self.curtain.take() {
            // The thread only draws: had it failed, the work would not care.
            let _ = curtain.join();
        }
        self.bar.finish_and_clear();
    }
}

/// Shows `bar` unless the work ends first.
fn show_later(bar: &ProgressBar, ended: &Receiver<()>) {
    if ended.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
        bar.set_draw_target(ProgressDrawTarget::stderr());
        bar.enable_steady_tick(BEAT);
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}
