package io.furrow.control.mission;

/**
 * Devices of a mission that are not written yet: those of a large mission are written in several transactions.
 *
 * @param next index of the next device among the planned ones
 * @param time start or end of the request for the devices, epoch ms
 */
record PendingAssignment(String mission, Kind kind, int next, long time) {
    enum Kind {
        /** The devices are desired to run. */
        START,
        /** The devices are no longer desired to run. */
        STOP
    }

    PendingAssignment at(int index) {
        return new PendingAssignment(mission, kind, index, time);
    }
}
