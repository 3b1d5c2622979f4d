/// What has so many parts takes milliseconds to be freed.
pub(crate) const LARGE: usize = 50_000;

/// Frees something that has about so many parts; if these are many, on a thread
/// of its own, so that nobody who asked to stop waits for it.
pub fn free_aside<T: Send + 'static>(large: T, parts: usize) {
    if parts >= LARGE {
        let freeing = std::thread::Builder::new().name("freeing".into());
        // Where no thread can be had, it is freed here.
        let _ = freeing.spawn(move || drop(large));
    }
}
