/** The analytics jobs, named like their results: `data.<job>` live, `<topic of the replay>.<job>` in a replay. */
export const ANALYTICS = ['collision', 'presence', 'temperature'];
