//! Everything from bytes to suggestions, on generated plants.

use bench::plant::plant;
use bench::whole;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

fn programs(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("bytes to suggestions");
    group.sample_size(10);
    for rungs in [1_000, 3_000, 10_000] {
        let text = plant(rungs);
        group.throughput(Throughput::Elements(rungs as u64));
        group.bench_with_input(
            BenchmarkId::from_parameter(rungs),
            &text,
            |bencher, text| {
                bencher.iter(|| whole::successions(text));
            },
        );
    }
    group.finish();
}

criterion_group!(benches, programs);
criterion_main!(benches);
