/// Bytes of the stack of [`on_a_small_stack`]: a quarter of what threads of
/// Rust have, or all of that where nothing is optimised and frames are several
/// times larger.
const STACK: usize = if cfg!(debug_assertions) {
    2 << 20
} else {
    512 << 10
};

/// Runs `work` on a thread with a small stack: a walk that goes deeper the
/// larger its text is does not come back from there.
pub fn on_a_small_stack<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    std::thread::scope(|scope| {
        std::thread::Builder::new()
            .stack_size(STACK)
            .spawn_scoped(scope, work)
            .expect("a thread")
            .join()
            .expect("work that comes back")
    })
}
