/** Command line, options and environment of a job. */
package io.furrow.flink.job;
