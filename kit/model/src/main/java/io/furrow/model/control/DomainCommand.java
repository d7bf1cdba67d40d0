package io.furrow.model.control;

import com.fasterxml.jackson.databind.node.ObjectNode;

/** What the topic {@code service.domainmanager} asks for. */
public sealed interface DomainCommand extends Command {
    String domain();

    record Create(String domain, DomainDetails details) implements DomainCommand {
        @Override
        public String verb() {
            return "create";
        }

        @Override
        public void describe(ObjectNode request) {
            request.put("domain", domain);
            details.describe(request);
        }
    }

    /** What the details do not say stays as it is. */
    record Change(String domain, DomainDetails details) implements DomainCommand {
        @Override
        public String verb() {
            return "change";
        }

        @Override
        public void describe(ObjectNode request) {
            request.put("domain", domain);
            details.describe(request);
        }
    }

    /** @param force whether missions that run in it are stopped, rather than the request refused */
    record Delete(String domain, boolean force) implements DomainCommand {
        @Override
        public String verb() {
            return "delete";
        }

        @Override
        public void describe(ObjectNode request) {
            request.put("domain", domain).put("force", force);
        }
    }

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
