/** Measures records per second through the job ingest, beside jobs that only copy bytes. */
package io.furrow.bench.ingest;
