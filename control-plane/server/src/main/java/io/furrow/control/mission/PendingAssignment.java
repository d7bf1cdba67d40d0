package io.furrow.control.mission;

/**
 * That devices of a mission are still to be written: a mission of many is written in several transactions.
 *
 * @param next index among the planned devices of the one that is written next
 * @param time from or until which the devices are requested, epoch ms
 */
record PendingAssignment(String mission, Kind kind, int next, long time) {
    /** What is written. */
    enum Kind {
        /** That they shall run. */
        START,
        /** That they shall run no more. */
        STOP
    }

    PendingAssignment at(int index) {
        return new PendingAssignment(mission, kind, index, time);
    }
}
