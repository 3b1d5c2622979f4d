//! Whether the editor that started the server is still there.
//!
//! A client that is killed cannot say `exit`. Mostly its end of the streams is
//! closed then, but not where another process holds them open.

use std::time::Duration;

/// How often to look.
const INTERVAL: Duration = Duration::from_secs(3);

/// Ends the process soon after the process `id` is gone.
#[cfg(unix)]
pub fn watch(id: u32) {
    let Some(parent) = i32::try_from(id)
        .ok()
        .and_then(rustix::process::Pid::from_raw)
    else {
        return;
    };
    std::thread::spawn(move || {
        loop {
            std::thread::sleep(INTERVAL);
            // Not being allowed to ask means that there is somebody.
            if rustix::process::test_kill_process(parent) == Err(rustix::io::Errno::SRCH) {
                std::process::exit(1);
            }
        }
    });
}

/// Elsewhere the end of standard input has to do.
#[cfg(not(unix))]
pub fn watch(_: u32) {}
