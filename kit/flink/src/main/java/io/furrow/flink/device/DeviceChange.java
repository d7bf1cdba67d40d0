package io.furrow.flink.device;

import io.furrow.model.device.DeviceVersion;

/**
 * A record of {@code service.devices}.
 *
 * @param key of the record: the identity of the device
 * @param partition of the record
 * @param offset of the record; increases within its partition
 * @param time record timestamp, epoch ms
 * @param version null if the device was deleted
 */
public record DeviceChange(String key, int partition, long offset, long time, DeviceVersion version) {}
