package io.furrow.fiware.http;

import java.util.Collection;

/** A refused request: HTTP status and the texts of Orion's {@code {"error", "description"}}. */
public final class NgsiError extends Exception {
    private static final long serialVersionUID = 1;

    private final int status;
    private final String error;

    public NgsiError(int status, String error, String description) {
        super(description);
        this.status = status;
        this.error = error;
    }

    public static NgsiError badRequest(String description) {
        return new NgsiError(400, "BadRequest", description);
    }

    static NgsiError notJson() {
        return new NgsiError(400, "ParseError", "Errors found in incoming JSON buffer");
    }

    public static NgsiError unsupported(String what) {
        return badRequest("not supported by the stand-in: " + what);
    }

    public static NgsiError noService() {
        return badRequest("Service not found. Check your URL as probably it is wrong.");
    }

    public static NgsiError noBody() {
        return new NgsiError(411, "ContentLengthRequired", "Zero/No Content-Length in PUT/POST/PATCH request");
    }

    public static NgsiError noEntity() {
        return notFound("The requested entity has not been found. Check type and id");
    }

    public static NgsiError noAttribute() {
        return notFound("The entity does not have such an attribute");
    }

    public static NgsiError noSubscription() {
        return notFound("The requested subscription has not been found. Check id");
    }

    /** Of a batch. */
    public static NgsiError noEntity(String label) {
        return notFound("do not exist: " + label + " - [entity itself]");
    }

    private static NgsiError notFound(String description) {
        return new NgsiError(404, "NotFound", description);
    }

    public static NgsiError badMethod() {
        return new NgsiError(405, "MethodNotAllowed", "method not allowed");
    }

    public static NgsiError ambiguous() {
        return new NgsiError(409, "TooManyResults", "More than one matching entity. Please refine your query");
    }

    static NgsiError tooLarge(long bytes, long limit) {
        return new NgsiError(413, "RequestEntityTooLarge", "payload size: " + bytes + ", max size supported: " + limit);
    }

    static NgsiError badMediaType(String type) {
        return new NgsiError(415, "UnsupportedMediaType", "not supported content type: " + type);
    }

    public static NgsiError exists() {
        return unprocessable("Already Exists");
    }

    public static NgsiError noAttributes(String label, Collection<String> names) {
        return unprocessable("do not exist: " + label + " - [ " + String.join(", ", names) + " ]");
    }

    private static NgsiError unprocessable(String description) {
        return new NgsiError(422, "Unprocessable", description);
    }

    /** A part of the request was executed. */
    public static NgsiError partial(String description) {
        return new NgsiError(422, "PartialUpdate", description);
    }

    public int status() {
        return status;
    }

    public String error() {
        return error;
    }
}
