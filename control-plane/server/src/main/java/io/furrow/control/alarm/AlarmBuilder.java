package io.furrow.control.alarm;

import java.util.List;

import io.furrow.model.control.AlarmKind;

/** Mutable builder of {@link Alarm}, a record with too many components to copy by constructor. */
final class AlarmBuilder {
    String alarm;
    AlarmKind kind;
    String subject;
    Severity severity;
    AlarmState state;
    Alarm.Change change;
    String text;
    List<Cause.AffectedDevice> devices;
    long raised;
    long changed;
    int count;
    Long until;
    Long mutedUntil;
    String acknowledgedBy;
    String reason;
    long sequence;
    String group;
    Integer affected;
    Integer total;
    Long seen;
    String inhibitedBy;
    String identity;

    AlarmBuilder() {}

    AlarmBuilder(Alarm from) {
        alarm = from.alarm();
        kind = from.kind();
        subject = from.subject();
        severity = from.severity();
        state = from.state();
        change = from.change();
        text = from.text();
        devices = from.devices();
        raised = from.raised();
        changed = from.changed();
        count = from.count();
        until = from.until();
        mutedUntil = from.mutedUntil();
        acknowledgedBy = from.acknowledgedBy();
        reason = from.reason();
        sequence = from.sequence();
        group = from.group();
        affected = from.affected();
        total = from.total();
        seen = from.seen();
        inhibitedBy = from.inhibitedBy();
        identity = from.identity();
    }

    void describe(Cause cause) {
        text = cause.text();
        devices = cause.devices();
        affected =
                cause.extent() == null ? null : Integer.valueOf(cause.extent().affected());
        total = cause.extent() == null ? null : cause.extent().total();
    }

    Alarm build() {
        return new Alarm(
                alarm,
                kind,
                subject,
                severity,
                state,
                change,
                text,
                devices,
                raised,
                changed,
                count,
                until,
                mutedUntil,
                acknowledgedBy,
                reason,
                sequence,
                group,
                affected,
                total,
                seen,
                inhibitedBy,
                identity);
    }
}
