package io.furrow.analytics.temperature;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

/**
 * A field's average temperature in one window, as the entity {@code Analytics:FieldTemperature}; one entity per field, whose
 * attributes each window replaces.
 *
 * @param domain empty where the field belongs to none
 * @param windowStart first instant of the window, epoch ms
 * @param windowEnd first instant after the window, epoch ms
 */
record FieldTemperature(String field, String domain, long windowStart, long windowEnd, RobustMean average) {
    private static final String TYPE = "Analytics:FieldTemperature";

    /** The window's last instant, epoch ms, so that whoever adds up windows to hours finds each in its hour. */
    long timestamp() {
        return windowEnd - 1;
    }

    Entity entity() {
        EntityBuilder entity = Entity.builder(TYPE + ":" + field, TYPE)
                .text("field", field)
                .number("averageTemperature", average.mean())
                .number("plainMean", average.plainMean())
                .number("spread", average.spread())
                .integer("devices", average.devices())
                .texts("suspects", average.suspects())
                .integer("windowStart", windowStart)
                .integer("windowEnd", windowEnd)
                .text("quality", average.verified() ? "robust" : "unverified");
        return domain.isEmpty() ? entity.build() : entity.text("Domain", domain).build();
    }
}
