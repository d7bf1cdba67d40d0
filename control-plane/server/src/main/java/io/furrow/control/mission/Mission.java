package io.furrow.control.mission;

import io.furrow.model.ngsi.StateRecord;

/**
 * What is requested of a mission: remembered, and a record of {@code service.missions} under its name. Its devices are listed on {@code
 * service.missions.devices}, see {@link DeviceListStore}.
 *
 * @param domain that it belongs to for good
 * @param template {@code <name>@<version>} that its devices were taken from; null if they were listed
 * @param parts how many parts its device list has
 * @param deviceCount how many devices the list has
 * @param running whether it shall run, now or from {@code start} on
 * @param start when it was or is to be started, epoch ms; null if it never was
 * @param duration after which it is stopped, ms; null for never
 * @param created when, epoch ms
 * @param sequence grows with every change of anything that is requested
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

    /** The same with a list that was written. */
    Mission listing(int newParts, int newDeviceCount) {
        return new Mission(
                mission, domain, template, newParts, newDeviceCount, running, start, duration, created, sequence);
    }

    Mission desired(Long newStart, Long newDuration, long newSequence) {
        return new Mission(
                mission, domain, template, parts, deviceCount, true, newStart, newDuration, created, newSequence);
    }

    Mission undesired(long newSequence) {
        return new Mission(mission, domain, template, parts, deviceCount, false, start, duration, created, newSequence);
    }
}
