/** The devices on {@code service.devices}, as of an event's time. */
package io.furrow.flink.device;
