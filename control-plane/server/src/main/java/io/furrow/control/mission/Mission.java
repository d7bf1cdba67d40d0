package io.furrow.control.mission;

import io.furrow.model.ngsi.StateRecord;

/**
 * The desired state of a mission: stored, and a record of {@code service.missions} keyed by its name. Its devices are
 * listed on {@code service.missions.devices}, see {@link DeviceListStore}.
 *
 * @param domain that it belongs to permanently
 * @param template {@code <name>@<version>} from which its devices were copied; null if they were listed
 * @param parts number of parts of its device list
 * @param deviceCount number of devices in the list
 * @param running whether it is desired to run, now or from {@code start} on
 * @param start when it was or will be started, epoch ms; null if never
 * @param duration after which it is stopped, ms; null for never
 * @param created when, epoch ms
 * @param sequence increases with every change of the desired state
 */
public record Mission(
        String mission,
        String domain,
        String template,
        int parts,
        int deviceCount,
        boolean running,
        Long start,
        Long duration,
        long created,
        long sequence)
        implements StateRecord {

    static Mission of(String mission, String domain, long now) {
        return new Mission(mission, domain, null, 0, 0, false, null, null, now, 0);
    }

    Mission from(String newTemplate) {
        return new Mission(
                mission, domain, newTemplate, parts, deviceCount, running, start, duration, created, sequence);
    }

    /** Returns the mission with another device list. */
    Mission listing(int newParts, int newDeviceCount) {
        return new Mission(
                mission, domain, template, newParts, newDeviceCount, running, start, duration, created, sequence);
    }

    Mission at(long newSequence) {
        return new Mission(
                mission, domain, template, parts, deviceCount, running, start, duration, created, newSequence);
    }

    Mission desired(Long newStart, Long newDuration, long newSequence) {
        return new Mission(
                mission, domain, template, parts, deviceCount, true, newStart, newDuration, created, newSequence);
    }

    Mission undesired(long newSequence) {
        return new Mission(mission, domain, template, parts, deviceCount, false, start, duration, created, newSequence);
    }
}
