package io.furrow.analytics.temperature;

/**
 * A reading from inside a field. A device in several fields gives one for each.
 *
 * @param field id of the field
 * @param domain of the field; empty where it belongs to none
 */
public record FieldReading(String field, String domain, Reading reading) {
    /** The device in this field, among those of all tenants; the length makes it unambiguous. */
    public String voter() {
        return field.length() + ":" + field + reading.deviceIdentity();
    }
}
