/** How many records a second pass through the job ingest, beside jobs that only copy bytes. */
package io.furrow.bench.ingest;
