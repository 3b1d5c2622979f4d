//! The most memory that a process has had at once.

/// The largest resident size of this process so far, in bytes, where the
/// system tells it (`VmHWM` of Linux).
///
/// It never falls, so a part is measured in a process of its own.
pub fn peak() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: usize = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}
