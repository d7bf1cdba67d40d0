package io.furrow.control.alarm;

/** What happens to an alarm that there is. */
public sealed interface AlarmEvent {
    /**
     * The cause was seen again.
     *
     * @param until how long it is so from now on, epoch ms; null until something says that it is over
     */
    record Repeated(Long until) implements AlarmEvent {}

    /** @param reason why it is over */
    record Ended(String reason) implements AlarmEvent {}

    /** @param user who looks at it; null where nobody says so */
    record Acknowledged(String user) implements AlarmEvent {}

    /** @param until when it is told again, epoch ms */
    record Muted(long until) implements AlarmEvent {}

    record Unmuted() implements AlarmEvent {}

    /** Nothing but time. */
    record TimePassed() implements AlarmEvent {}
}
