/** What {@code service.devices} says of devices, as of an event's time. */
package io.furrow.flink.device;
