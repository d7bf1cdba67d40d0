/** Journals on this machine's disk, side by side; see docs/adr/0007-journal.md. */
package io.furrow.bench.journal;
