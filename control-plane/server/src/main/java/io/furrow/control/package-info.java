/**
 * The control plane as one service: managers, REST API, provisioning, farm watch.
 *
 * <p><b>In</b>: requests on the managers' topics and over REST, statuses of hosts and players, results of analytics.
 *
 * <p><b>Out</b>: the desired state on {@code service.*}, responses, the audit, alarms, entities on {@code
 * data.context}.
 *
 * <p><b>Must not know</b>: Flink, and how devices are simulated.
 */
package io.furrow.control;
