/** Event time: watermarks, lateness, deduplication within a time. */
package io.furrow.flink.time;
