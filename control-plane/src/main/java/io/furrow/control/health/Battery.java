package io.furrow.control.health;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;

/**
 * Reads the battery charge of a device, 0 to 1, from the attribute {@code battery}: a number (percent if above 1), or
 * with FIROS a sensor_msgs/BatteryState, whose {@code percentage} is 0 to 1.
 */
final class Battery {
    static final String ATTRIBUTE = "battery";

    private static final String PERCENTAGE = "percentage";
    private static final String QUOTE = "%27";
    private static final double PERCENT = 100;

    private Battery() {}

    /** Returns null if the entity has no valid charge. */
    static Double chargeOf(Entity entity) {
        Double said = entity.number(ATTRIBUTE).orElse(null);
        if (said == null) {
            said = entity.text(ATTRIBUTE).map(Battery::ofRobot).orElse(null);
        }
        if (said == null || said < 0 || said > PERCENT) {
            return null;
        }
        return said > 1 ? said / PERCENT : said;
    }

    private static Double ofRobot(String text) {
        try {
            JsonNode state = NgsiJson.mapper().readTree(text.replace(QUOTE, "\""));
            JsonNode charge = state == null ? null : state.path(PERCENTAGE);
            return charge == null || !charge.isNumber() ? null : Double.valueOf(charge.doubleValue());
        } catch (com.fasterxml.jackson.core.JsonProcessingException e) {
            return null; // a text that is not a ROS message contains no charge
        }
    }
}
