/** The analytics jobs, each named as its results: `data.<job>` live, `<topic of the replay>.<job>` in a replay. */
export const ANALYTICS = ['collision', 'presence', 'temperature'];
