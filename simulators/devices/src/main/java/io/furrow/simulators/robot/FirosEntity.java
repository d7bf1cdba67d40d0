package io.furrow.simulators.robot;

import java.time.Instant;
import java.util.Locale;

import com.fasterxml.jackson.databind.node.TextNode;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.position.Position;

/** Writes a robot as FIROS does: ROS messages as text, JSON whose quotes are {@code %27}. */
public final class FirosEntity {
    private static final String QUOTE = "%27";
    private static final double HOURS_PER_BATTERY = 8;
    private static final double MIN_BATTERY_LEVEL = 0.2;

    private FirosEntity() {}

    /** Type {@code ROBOT}, with its position in {@code gnss} (sensor_msgs/NavSatFix) and {@code Time} in epoch ms. */
    public static EntityBuilder located(String id, Position place, Instant now) {
        return Entity.builder(id, "ROBOT")
                .attribute("gnss", "sensor_msgs.msg.NavSatFix", TextNode.valueOf(navSatFix(place, now)))
                .integer("Time", now.toEpochMilli());
    }

    /**
     * Adds {@code speed} (m/s), {@code heading} (degrees clockwise from north), {@code state} (std_msgs/String: {@code
     * Running}, {@code Stopped}, {@code Waiting}) and {@code battery} (sensor_msgs/BatteryState).
     */
    public static EntityBuilder of(String id, RobotModel robot, RobotState state) {
        Trajectory.Pose pose = robot.pose(state);
        String word = state.activity().name().charAt(0)
                + state.activity().name().substring(1).toLowerCase(Locale.ROOT);
        return located(id, pose.place(), state.time())
                .number("speed", robot.speed(state))
                .number("heading", pose.heading())
                .attribute("state", "std_msgs.msg.String", TextNode.valueOf(escaped("{'data': '%s'}".formatted(word))))
                .attribute(
                        "battery",
                        "sensor_msgs.msg.BatteryState",
                        TextNode.valueOf(escaped(
                                String.format(Locale.ROOT, "{'percentage': %.3f}", batteryLevel(state.driven())))));
    }

    /** Falls with the time driven, from 1 to 0.2 in eight hours; then the battery is replaced. */
    static double batteryLevel(double driven) {
        double used = driven / 3600 % HOURS_PER_BATTERY / HOURS_PER_BATTERY;
        return 1 - (1 - MIN_BATTERY_LEVEL) * used;
    }

    private static String navSatFix(Position place, Instant now) {
        return escaped(String.format(
                Locale.ROOT,
                "{'header': {'seq': 0, 'stamp': {'secs': %d, 'nsecs': %d}, 'frame_id': 'gps'}, "
                        + "'status': {'status': 0, 'service': 1}, 'latitude': %.8f, 'longitude': %.8f, "
                        + "'altitude': 0.0, 'position_covariance_type': 0}",
                now.getEpochSecond(),
                now.getNano(),
                place.latitude(),
                place.longitude()));
    }

    private static String escaped(String json) {
        return json.replace("'", QUOTE);
    }
}
