package io.furrow.control.domain;

import java.util.List;
import java.util.OptionalLong;
import java.util.function.Supplier;

import io.furrow.control.manager.CommandHandler;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.Quota;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.Table;
import io.furrow.kafka.field.FieldEdit;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.DomainDetails;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.text.Counts;
import io.furrow.model.topic.Topics;

/** Executes or rejects commands on domains. A rejected command changes nothing. */
public final class DomainCommandHandler implements CommandHandler<DomainCommand> {
    private static final int MAX_NAMED = 100;

    private final Table<Domain> domains;
    private final DomainMissions missions;
    private final Supplier<List<FieldVersion>> fields;
    private final Sequence sequence;
    private final Quota quota;
    private final EventPublisher publisher;

    /**
     * Resources shared with missions.
     *
     * @param sequence of the desired state
     * @param quota for the size of all definitions
     * @param fields every version of {@code service.fields}
     */
    record Dependencies(Sequence sequence, Quota quota, Supplier<List<FieldVersion>> fields) {}

    DomainCommandHandler(
            Table<Domain> domains, DomainMissions missions, Dependencies dependencies, EventPublisher publisher) {
        this.domains = domains;
        this.missions = missions;
        this.sequence = dependencies.sequence();
        this.quota = dependencies.quota();
        this.fields = dependencies.fields();
        this.publisher = publisher;
    }

    @Override
    public OptionalLong sequenceOf(DomainCommand command) {
        Domain existing = domains.get(command.domain());
        return existing == null ? OptionalLong.empty() : OptionalLong.of(existing.sequence());
    }

    @Override
    public CommandResult answer(DomainCommand command, long now) throws RejectedException {
        if (command instanceof DomainCommand.Create create) {
            return create(create, now);
        }
        Domain existing = domains.get(command.domain());
        if (existing == null) {
            throw new RejectedException(ErrorCode.UNKNOWN_DOMAIN, "there is no domain '" + command.domain() + "'");
        }
        if (command instanceof DomainCommand.Change change) {
            return change(existing, change.details().over(existing.details()), now);
        } else if (command instanceof DomainCommand.Patch patch) {
            return change(existing, existing.details().patched(patch.details()), now);
        }
        return delete(existing, ((DomainCommand.Delete) command).force(), now);
    }

    private CommandResult create(DomainCommand.Create create, long now) throws RejectedException {
        if (domains.contains(create.domain())) {
            throw new RejectedException(
                    ErrorCode.DOMAIN_EXISTS,
                    "domain '%s' exists already; change it instead".formatted(create.domain()));
        }
        store(null, Domain.of(create.domain(), create.details(), now, sequence.next()));
        return about(create.domain(), "created");
    }

    private CommandResult change(Domain existing, DomainDetails details, long now) throws RejectedException {
        store(existing, existing.with(details, now, sequence.next()));
        return about(existing.domain(), "changed");
    }

    /** Deletes a domain with its missions and ends its fields. Recorded data stays. */
    private CommandResult delete(Domain existing, boolean force, long now) throws RejectedException {
        String domain = existing.domain();
        List<String> active = missions.activeIn(domain);
        if (!active.isEmpty() && !force) {
            throw new RejectedException(
                    ErrorCode.MISSIONS_RUNNING,
                    "%s running in domain '%s', '%s' among them; stop them first, or delete with force"
                            .formatted(Counts.are(active.size(), "mission"), domain, active.get(0)));
        }
        List<String> removed = missions.in(domain);
        removed.forEach(missions::remove);
        FieldEdit ends = FieldEdit.endOfDomain(domain, now, fields.get());
        ends.written().forEach(end -> publisher.put(Topics.FIELDS, end.key(), end.toBytes()));
        ends.removed().forEach(key -> publisher.put(Topics.FIELDS, key, null));
        quota.use(-existing.toBytes().length);
        domains.put(domain, null);
        publisher.put(Topics.DOMAINS, domain, null);
        return CommandResult.of("deleted")
                .with("domain", domain)
                .with("missionCount", removed.size())
                .with("missions", named(removed))
                .with("stopped", named(active))
                .with("fieldCount", ends.ids().size())
                .with("fields", named(ends.ids()));
    }

    /** Truncates a list of names to the maximum of an answer. */
    private static List<String> named(List<String> names) {
        return names.subList(0, Math.min(MAX_NAMED, names.size()));
    }

    /** @param before null if there was none */
    private void store(Domain before, Domain domain) throws RejectedException {
        byte[] value = domain.toBytes();
        quota.replace(before == null ? null : before.toBytes(), value);
        domains.put(domain.domain(), domain);
        publisher.put(Topics.DOMAINS, domain.domain(), value);
    }

    private static CommandResult about(String domain, String status) {
        return CommandResult.of(status).with("domain", domain).with("topic", Topics.realtime(domain));
    }
}
