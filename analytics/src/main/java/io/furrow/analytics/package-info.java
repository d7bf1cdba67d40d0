/**
 * The analytics jobs; each package is one job.
 *
 * <p><b>In</b>: {@code data.raw} or the topic of a replay, {@code service.fields}, {@code service.devices}.
 *
 * <p><b>Out</b>: result entities of {@code io.furrow.model.result}, each job on its topic, and dead letters.
 *
 * <p><b>Must not know</b>: HTTP, the context broker, alarms, another job.
 */
package io.furrow.analytics;
