package io.furrow.control.health;

import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.FirosJson;
import io.furrow.model.ngsi.Numbers;
import io.furrow.model.ngsi.Quantity;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Reads the battery charge of a device, 0 to 1, from the attribute {@code battery} or {@code batteryLevel}: a number,
 * or with FIROS a sensor_msgs/BatteryState, whose {@code percentage} is 0 to 1. Metadata {@code unitCode} tells whether
 * a number is in percent; without it, the numbers of a device that has ever reported more than 1 are. The dashboard's
 * page reads charges by the same rules.
 */
final class Battery {
    static final String ATTRIBUTE = "battery";

    private static final List<String> ATTRIBUTES = List.of(ATTRIBUTE, "batteryLevel");
    private static final String PERCENTAGE = "percentage";
    private static final double PERCENT = 100;

    private Battery() {}

    /** Returns null if the entity has no valid level. */
    static Double levelOf(Entity entity) {
        return levelOf(entity, false);
    }

    /** @param percent whether numbers without a unit are in percent, see {@link #isPercent} */
    static Double levelOf(Entity entity, boolean percent) {
        String attribute = attributeOf(entity);
        Optional<Double> number = entity.number(attribute);
        Optional<Double> level = number.isEmpty()
                ? entity.value(attribute).map(Battery::ofRobot).map(value -> share(value, value > 1))
                : Quantity.unitOf(entity, attribute).isEmpty()
                        ? number.map(value -> share(value, value > 1 || percent))
                        : Quantity.SHARE.of(entity, attribute);
        return level.filter(share -> share >= 0 && share <= 1).orElse(null);
    }

    static double share(double value, boolean percent) {
        return percent ? value / PERCENT : value;
    }

    /** Whether the entity shows that its device reports numbers without a unit in percent. */
    static boolean isPercent(Entity entity) {
        return isUnitless(entity) && entity.number(attributeOf(entity)).orElseThrow() > 1;
    }

    /** Whether the battery is a number without a unit. */
    static boolean isUnitless(Entity entity) {
        String attribute = attributeOf(entity);
        return Quantity.unitOf(entity, attribute).isEmpty()
                && entity.number(attribute).isPresent();
    }

    private static String attributeOf(Entity entity) {
        return ATTRIBUTES.stream()
                .filter(name -> entity.value(name).isPresent())
                .findFirst()
                .orElse(ATTRIBUTE);
    }

    /** @param value a message as object or text of FIROS */
    private static Double ofRobot(JsonNode value) {
        try {
            JsonNode state = value.isTextual() ? FirosJson.read(value.textValue()) : value;
            return Numbers.finite(state.path(PERCENTAGE)).orElse(null);
        } catch (UnreadableException e) {
            return null; // not a ROS message
        }
    }
}
