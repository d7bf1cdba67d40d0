package io.furrow.model.control;

import com.fasterxml.jackson.annotation.JsonTypeName;
import com.fasterxml.jackson.annotation.JsonUnwrapped;

/** What the topic {@code service.domainmanager} asks for. */
public sealed interface DomainCommand extends Command {
    String domain();

    @JsonTypeName("create")
    record Create(String domain, @JsonUnwrapped DomainDetails details) implements DomainCommand {}

    /** What the details do not say stays as it is. */
    @JsonTypeName("change")
    record Change(String domain, @JsonUnwrapped DomainDetails details) implements DomainCommand {}

    /** @param force whether missions that run in it are stopped, rather than the request refused */
    @JsonTypeName("delete")
    record Delete(String domain, boolean force) implements DomainCommand {}

    /** A request without {@code command} creates: that is how the WeLASER dashboard asks. */
    static DomainCommand read(String verb, JsonObjectReader members) throws RejectedException {
        String domain = members.name("domain");
        return switch (verb == null ? "create" : verb) {
            case "create" -> new Create(domain, DomainDetails.read(members));
            case "change" -> new Change(domain, DomainDetails.read(members));
            case "delete" -> new Delete(domain, members.flag("force"));
            default -> throw Requests.unknown(verb, "create, change, delete");
        };
    }
}
