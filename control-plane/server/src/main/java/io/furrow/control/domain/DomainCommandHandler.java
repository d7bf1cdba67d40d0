package io.furrow.control.domain;

import java.util.List;
import java.util.function.Supplier;

import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.Quota;
import io.furrow.control.manager.Records;
import io.furrow.control.manager.Sequence;
import io.furrow.kafka.field.FieldEdit;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.text.Counts;
import io.furrow.model.topic.Topics;

/** Executes or rejects commands on domains. A rejected command changes nothing. */
public final class DomainCommandHandler {
    private static final int MAX_NAMED = 100;

    private final Records<Domain> domains;
    private final DomainMissions missions;
    private final Supplier<List<FieldVersion>> fields;
    private final Sequence sequence;
    private final Quota quota;
    private final EventPublisher outbox;

    /**
     * Resources shared with missions.
     *
     * @param sequence of the desired state
     * @param quota for the size of all definitions
     * @param fields every version of {@code service.fields}
     */
    record Means(Sequence sequence, Quota quota, Supplier<List<FieldVersion>> fields) {}

    DomainCommandHandler(Records<Domain> domains, DomainMissions missions, Means means, EventPublisher outbox) {
        this.domains = domains;
        this.missions = missions;
        this.sequence = means.sequence();
        this.quota = means.quota();
        this.fields = means.fields();
        this.outbox = outbox;
    }

    /** @param now epoch ms */
    public CommandResult answer(DomainCommand command, long now) throws RejectedException {
        if (command instanceof DomainCommand.Create create) {
            return create(create, now);
        }
        Domain known = domains.get(command.domain());
        if (known == null) {
            throw new RejectedException(ErrorCode.UNKNOWN_DOMAIN, "there is no domain '" + command.domain() + "'");
        }
        if (command instanceof DomainCommand.Change change) {
            keep(known, known.changed(change.details(), now, sequence.next()));
            return about(known.domain(), "changed");
        }
        return delete(known, ((DomainCommand.Delete) command).force(), now);
    }

    private CommandResult create(DomainCommand.Create create, long now) throws RejectedException {
        if (domains.contains(create.domain())) {
            throw new RejectedException(
                    ErrorCode.DOMAIN_EXISTS,
                    "domain '%s' exists already; use 'change' to change it".formatted(create.domain()));
        }
        keep(null, Domain.of(create.domain(), create.details(), now, sequence.next()));
        return about(create.domain(), "created");
    }

    /** With its missions; its fields end. What is stored of them stays. */
    private CommandResult delete(Domain known, boolean force, long now) throws RejectedException {
        String domain = known.domain();
        List<String> active = missions.activeIn(domain);
        if (!active.isEmpty() && !force) {
            throw new RejectedException(
                    ErrorCode.MISSIONS_RUNNING,
                    "%s running in domain '%s', '%s' among them; stop them first, or delete with force"
                            .formatted(Counts.are(active.size(), "mission"), domain, active.get(0)));
        }
        List<String> gone = missions.in(domain);
        gone.forEach(missions::remove);
        FieldEdit ends = FieldEdit.endOfDomain(domain, now, fields.get());
        ends.written().forEach(end -> outbox.put(Topics.FIELDS, end.key(), end.toBytes()));
        ends.removed().forEach(key -> outbox.put(Topics.FIELDS, key, null));
        quota.use(-known.toBytes().length);
        domains.put(domain, null);
        outbox.put(Topics.DOMAINS, domain, null);
        return CommandResult.of("deleted")
                .with("domain", domain)
                .with("missionCount", gone.size())
                .with("missions", named(gone))
                .with("stopped", named(active))
                .with("fieldCount", ends.ids().size())
                .with("fields", named(ends.ids()));
    }

    /** As many as an answer has room for. */
    private static List<String> named(List<String> names) {
        return names.subList(0, Math.min(MAX_NAMED, names.size()));
    }

    /** @param before null if there was none */
    private void keep(Domain before, Domain domain) throws RejectedException {
        byte[] value = domain.toBytes();
        quota.replace(before == null ? null : before.toBytes(), value);
        domains.put(domain.domain(), domain);
        outbox.put(Topics.DOMAINS, domain.domain(), value);
    }

    private static CommandResult about(String domain, String status) {
        return CommandResult.of(status).with("domain", domain).with("topic", Topics.realtime(domain));
    }
}
