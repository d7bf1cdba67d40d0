/** Event time: watermarks, lateness, epochs of replays. */
package io.furrow.flink.time;
