package io.furrow.simulators.device;

import java.time.Duration;

import com.fasterxml.jackson.annotation.JsonIgnore;
import com.fasterxml.jackson.annotation.JsonSubTypes;
import com.fasterxml.jackson.annotation.JsonTypeInfo;

/** One device of a {@link Scenario}: what it is, where it goes and how often it reports. */
@JsonTypeInfo(use = JsonTypeInfo.Id.NAME, property = "type")
@JsonSubTypes({
    @JsonSubTypes.Type(value = DevicePlan.ThermometerPlan.class, name = "Thermometer"),
    @JsonSubTypes.Type(value = DevicePlan.CameraPlan.class, name = "Camera"),
    @JsonSubTypes.Type(value = DevicePlan.RobotPlan.class, name = "Robot")
})
public sealed interface DevicePlan {
    /** The id at the IoT Agent and in MQTT topics; of a robot, which has none there, its name in logs. */
    String id();

    /** The id of its entity in the context broker. */
    String entity();

    Route route();

    long periodMs();

    @JsonIgnore
    default Duration period() {
        return Duration.ofMillis(periodMs());
    }

    /**
     * @param meanCelsius mean of the day at its place
     * @param stuckAtCelsius what it shows for ever when it is defective; null when it is sound
     */
    record ThermometerPlan(
            String id, String entity, Route route, long periodMs, double meanCelsius, Double stuckAtCelsius)
            implements DevicePlan {
        public ThermometerPlan {
            check(id, entity, route, periodMs);
        }
    }

    /** A camera that sends a picture per period. */
    record CameraPlan(String id, String entity, Route route, long periodMs) implements DevicePlan {
        public CameraPlan {
            check(id, entity, route, periodMs);
        }
    }

    /** @param tellsMission whether it reports {@code Domain} and {@code Mission}, which FIROS by itself does not */
    record RobotPlan(String id, String entity, Route route, long periodMs, boolean tellsMission) implements DevicePlan {
        public RobotPlan {
            check(id, entity, route, periodMs);
        }
    }

    private static void check(String id, String entity, Route route, long periodMs) {
        if (id == null || entity == null || route == null || periodMs <= 0) {
            throw new IllegalArgumentException(
                    "device " + id + " needs id, entity, route and a periodMs above 0 in the scenario");
        }
    }
}
