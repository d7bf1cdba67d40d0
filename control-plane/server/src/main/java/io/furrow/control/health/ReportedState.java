package io.furrow.control.health;

import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.function.Predicate;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Entity;

/**
 * Distinguishes reports of a device from notifications that the context broker sends when a command to the device is
 * sent, answered or expired. Stores only hashes of the values.
 */
final class ReportedState {
    /** Attributes that are assigned to a device, not measured by it; they may exist before its first report. */
    private static final Pattern ASSIGNED = Pattern.compile("Domain|Mission|TimeInstant");

    private final int[] measured;
    private final int[] commands;
    /** Of the time at which the IoT Agent received the report. */
    private final int stamp;

    private ReportedState(int[] measured, int[] commands, int stamp) {
        this.measured = measured;
        this.commands = commands;
        this.stamp = stamp;
    }

    static ReportedState of(Entity entity) {
        List<Map.Entry<String, JsonNode>> attributes = entity.attributes();
        return new ReportedState(
                hashes(attributes, ReportedState::isMeasured),
                hashes(attributes, each -> Entity.isOfCommand(each.getKey(), each.getValue())),
                entity.value("TimeInstant").hashCode());
    }

    private static int[] hashes(
            List<Map.Entry<String, JsonNode>> attributes, Predicate<Map.Entry<String, JsonNode>> selection) {
        return attributes.stream()
                .filter(selection)
                .mapToInt(each -> 31 * each.getKey().hashCode()
                        + each.getValue().path("value").hashCode())
                .sorted()
                .toArray();
    }

    /** Whether the attribute may come from the device itself. */
    static boolean isMeasured(Map.Entry<String, JsonNode> attribute) {
        String name = attribute.getKey();
        return !ASSIGNED.matcher(name).matches()
                && !Entity.isOfCommand(name, attribute.getValue())
                && !Entity.BUILT_INS.contains(name);
    }

    /**
     * Whether this state is a new report after another one: a measured value changed, or the event time or the IoT
     * Agent's time changed without a change of commands. All reports of a device whose clock stands still have the same
     * event time.
     *
     * @param atAnotherTime whether the two states have different event times
     */
    boolean isReportAfter(ReportedState before, boolean atAnotherTime) {
        return isChanged(before.measured, measured)
                || (atAnotherTime || stamp != before.stamp) && !isChanged(before.commands, commands);
    }

    private static boolean isChanged(int[] before, int[] now) {
        return Arrays.stream(now).anyMatch(each -> Arrays.binarySearch(before, each) < 0);
    }
}
