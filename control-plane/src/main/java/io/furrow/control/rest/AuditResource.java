package io.furrow.control.rest;

import jakarta.ws.rs.DefaultValue;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.model.control.ErrorCode;

/** {@code /api/audit}. */
@Path("/api/audit")
@Produces(MediaType.APPLICATION_JSON)
public final class AuditResource {
    private final ServiceView view;

    AuditResource(ServiceView view) {
        this.view = view;
    }

    /** The newest first. @param limit 1 to {@value ServiceView#AUDITED} */
    @GET
    public Response newest(@QueryParam("limit") @DefaultValue("100") String limit) {
        if (!limit.matches("[1-9][0-9]{0,3}") || Integer.parseInt(limit) > ServiceView.AUDITED) {
            throw new ProblemException(
                    ErrorCode.WRONG_MEMBER, "'limit' must be a whole number from 1 to " + ServiceView.AUDITED);
        }
        return Replies.ok(view.newestAudited(Integer.parseInt(limit)));
    }
}
