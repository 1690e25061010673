mod cross_check;
mod exact;
mod ray;
mod verdict;
