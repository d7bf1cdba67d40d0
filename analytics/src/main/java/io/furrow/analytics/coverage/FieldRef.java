package io.furrow.analytics.coverage;

import io.furrow.analytics.field.Field;

/**
 * The version of a field that a robot works in.
 *
 * @param validFrom begin of the version, epoch ms
 * @param name for display; empty if it has none
 * @param domain empty if it belongs to none
 */
public record FieldRef(String id, long validFrom, String name, String domain) {
    static FieldRef of(Field field) {
        return new FieldRef(field.id(), field.validFrom(), field.name(), field.domain());
    }
}
