//! Reading real XML files, beside a bare pass over the events of the same
//! bytes. Without the corpus nothing is measured.

use std::hint::black_box;

use bench::real::{RealFile, files};
use bench::xml;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn reading(criterion: &mut Criterion) {
    for format in ["l5x", "plcopen"] {
        let files = files(format);
        if files.is_empty() {
            continue;
        }
        let each = |read: &dyn Fn(&RealFile)| files.iter().for_each(read);
        let mut group = criterion.benchmark_group(format!("reading all {format} files"));
        let bytes = files.iter().map(|file| file.bytes.len() as u64).sum();
        group.throughput(Throughput::Bytes(bytes)).sample_size(10);
        group.bench_function("gradus", |bencher| {
            bencher.iter(|| each(&|file| drop(black_box(ladder::read(&file.bytes)))));
        });
        group.bench_function("bare XML events", |bencher| {
            bencher.iter(|| {
                each(&|file| {
                    black_box(xml::events(&file.bytes));
                })
            });
        });
        group.finish();
    }
}

criterion_group!(benches, reading);
criterion_main!(benches);
