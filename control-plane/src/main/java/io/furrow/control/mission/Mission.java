package io.furrow.control.mission;

import java.util.List;

import com.fasterxml.jackson.databind.node.ArrayNode;

import io.furrow.control.manager.StateJson;
import io.furrow.model.control.MissionDevices;
import io.furrow.model.event.FiwareScope;

/**
 * What is wanted of a mission: remembered, and a record of {@code service.missions} under its name.
 *
 * @param domain that it belongs to for good
 * @param template {@code <name>@<version>} that its devices were taken from; null where they were listed
 * @param devices as requests have them; owned by the mission
 * @param running whether it shall run, now or from {@code start} on
 * @param start when it was or is to be started, epoch ms; null where it never was
 * @param duration after which it is stopped, ms; null for never
 * @param created when, epoch ms
 * @param sequence grows with every change of anything that is wanted
 */
public record Mission(
        String mission,
        String domain,
        String template,
        ArrayNode devices,
        boolean running,
        Long start,
        Long duration,
        long created,
        long sequence) {

    MissionDevices groups() {
        return MissionDevices.of(devices);
    }

    /** Ids of the entities of all its devices, in the order of its groups. */
    public List<String> deviceIds() {
        return Roster.of(this, FiwareScope.DEFAULT, 0).stream()
                .map(device -> device.version().id())
                .toList();
    }

    /** The same with other devices. */
    Mission with(String newTemplate, ArrayNode newDevices) {
        return new Mission(mission, domain, newTemplate, newDevices, running, start, duration, created, sequence);
    }

    Mission wanted(Long newStart, Long newDuration, long newSequence) {
        return new Mission(mission, domain, template, devices, true, newStart, newDuration, created, newSequence);
    }

    Mission unwanted(long newSequence) {
        return new Mission(mission, domain, template, devices, false, start, duration, created, newSequence);
    }

    byte[] toBytes() {
        return StateJson.write(this);
    }
}
