package io.furrow.model.control;

import com.fasterxml.jackson.annotation.JsonTypeName;
import com.fasterxml.jackson.annotation.JsonUnwrapped;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** A command on the topic {@code service.domainmanager}. */
public sealed interface DomainCommand extends Command {
    String domain();

    @JsonTypeName("create")
    record Create(String domain, @JsonUnwrapped DomainDetails details) implements DomainCommand {}

    /** Changes a domain; omitted details stay unchanged. */
    @JsonTypeName("change")
    record Change(String domain, @JsonUnwrapped DomainDetails details) implements DomainCommand {}

    /**
     * Merges details into those of a domain, as RFC 7396 defines it.
     *
     * @param details members of a request; null removes one
     */
    @JsonTypeName("patch")
    record Patch(String domain, ObjectNode details) implements DomainCommand {
        @Override
        public void describe(ObjectNode request) {
            request.put("domain", domain);
            request.setAll(details);
        }
    }

    /** @param force whether to stop its running missions instead of rejecting the request */
    @JsonTypeName("delete")
    record Delete(String domain, boolean force) implements DomainCommand {}

    /** Reads a command; a request without {@code command} creates, as the WeLASER dashboard sends it. */
    static DomainCommand read(String verb, JsonObjectReader members) throws RejectedException {
        String domain = members.name("domain");
        return switch (verb == null ? "create" : verb) {
            case "create" -> new Create(domain, DomainDetails.read(members));
            case "change" -> new Change(domain, DomainDetails.read(members));
            case "patch" -> new Patch(domain, DomainDetails.members(members.json()));
            case "delete" -> new Delete(domain, members.flag("force"));
            default -> throw Requests.unknown(verb, "create, change, patch, delete");
        };
    }
}
