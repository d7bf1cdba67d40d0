package io.furrow.analytics.temperature;

/**
 * A reading from inside a field. A device in several fields gives one for each.
 *
 * @param field id of the field
 * @param domain of the field; empty if it belongs to none
 * @param validFrom since when the field is as it is, epoch ms
 */
public record FieldReading(String field, String domain, long validFrom, Reading reading) {
    /**
     * The device in this field, among those of all topics and tenants; the length makes it unambiguous. Devices of one id and several
     * types share it, as state of older builds has it.
     */
    String voter() {
        return field.length() + ":" + field + reading.deviceIdentity();
    }
}
