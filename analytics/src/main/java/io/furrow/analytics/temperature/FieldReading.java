package io.furrow.analytics.temperature;

/**
 * A reading from inside a field. A device in several fields gives one for each.
 *
 * @param field id of the field
 * @param domain of the field; empty if it has none
 * @param validFrom start of the field's version, epoch ms
 */
public record FieldReading(String field, String domain, long validFrom, Reading reading) {
    /** The device in this field, unique across topics and tenants; the length makes it unambiguous. */
    String voter() {
        return field.length() + ":" + field + reading.deviceIdentity();
    }
}
