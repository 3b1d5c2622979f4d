mod forms;
mod places;

#[test]
fn probe() {
    for form in forms::FORMS {
        let mut times = vec![];
        let mut codes = std::collections::BTreeMap::new();
        let mut rungs = 0;
        let mut format = ladder::Format::Unknown;
        let from: usize = std::env::var("FROM")
            .ok()
            .and_then(|n| n.parse().ok())
            .unwrap_or(0);
        let at = forms::FORMS
            .iter()
            .position(|f| std::ptr::eq(f, form))
            .unwrap();
        if at < from {
            continue;
        }
        println!("{at} {}", form.name);
        for n in [1000, 2000, 4000] {
            let text = (form.text)(n);
            let start = std::time::Instant::now();
            let reading = ladder::read(text.as_bytes());
            times.push(start.elapsed().as_micros() as f64 / 1000.0);
            rungs = reading.program.rungs().count();
            format = reading.program.format;
            assert_eq!(places::outside(text.as_bytes(), &reading), None);
            codes.clear();
            for d in &reading.diagnostics {
                *codes.entry(d.code.to_string()).or_insert(0) += 1;
            }
        }
        let flag = if times[2] > 5.0 * times[0].max(0.5) {
            "  <<<<<"
        } else {
            ""
        };
        println!(
            "{:45} {:?} {:8.1} {:8.1} {:8.1} rungs {rungs} {codes:?}{flag}",
            form.name, format, times[0], times[1], times[2]
        );
    }
}
